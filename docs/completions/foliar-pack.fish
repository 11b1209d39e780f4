complete -c foliar-pack -s o -l output -d 'Output: .glb, .gltf, or - for standard output; not the master itself' -r -F
complete -c foliar-pack -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar-pack -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-pack -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-pack -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-pack -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-pack -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-pack -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-pack -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-pack -l for -d 'What the packed file is for.' -r -f -a "core\t'Any glTF viewer, no shader: NORMAL realigned, `COLOR_0` times the ambient coefficient.'
blender\t'Blender: float attributes of equal widths, vectors with Z up.'
luft07\t'Luft07\'s own encoding: a vector per vertex along the realigned normal, as long as the ambient coefficient.'"
complete -c foliar-pack -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-pack -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-pack -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-pack -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-pack -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-pack -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-pack -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-pack -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-pack -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-pack -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar-pack -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-pack -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-pack -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-pack -s q -l quiet -d 'Prints errors only'
complete -c foliar-pack -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-pack -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-pack -s V -l version -d 'Print version'
