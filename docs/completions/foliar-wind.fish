complete -c foliar-wind -s o -l output -d 'Output: .glb, .gltf, .layer (one room alone), or - for standard output' -r -F
complete -c foliar-wind -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar-wind -l picture -d 'Draws what was baked' -r -F
complete -c foliar-wind -l cache -d 'Keeps layers by content: an unchanged room is not baked again' -r -F
complete -c foliar-wind -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-wind -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-wind -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-wind -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-wind -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-wind -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-wind -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-wind -l leaf -d 'Parts that are leaves.' -r
complete -c foliar-wind -l wood -d 'Parts that are wood.' -r
complete -c foliar-wind -l other -d 'Parts that are no plant.' -r
complete -c foliar-wind -l method -d 'How parents are chosen. [default "robust"]' -r -f -a "robust\t'Contact at ends against capsules, minimum arborescence with the ground as root; wood in one piece that clearly forks is taken apart by the shape of its surface.'
fused\t'The same, and every piece whose rings fall into parts is taken apart.'
kusternig07\t'The paper\'s own words: by diameter, whoever intersects (Kusternig07 section 5). To show the difference.'"
complete -c foliar-wind -l continuation -d 'Whether a branch that goes on where its parent ends is one with it. [default "merge"]' -r -f -a "merge\t'One branch; arc lengths go on.'
split\t'Two.'"
complete -c foliar-wind -l levels -d 'Levels of branches that sway on their own, stems first; deeper ones move as what they grow from. [at least 1, at most 4, default 4]' -r
complete -c foliar-wind -l exponents -d 'How displacement grows along a branch, level by level: the weight to this power. Above 1 a branch bends, at 1 it leans. Shaders must use the same: the places where bark meets bark are matched for these. [default [2.0,1.5,1.5,1.0]]' -r
complete -c foliar-wind -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-wind -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-wind -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-wind -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-wind -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-wind -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-wind -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-wind -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-wind -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-wind -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar-wind -l explain-roles -d 'Prints each part with its role and the evidence; without an output, stops there'
complete -c foliar-wind -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-wind -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-wind -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-wind -s q -l quiet -d 'Prints errors only'
complete -c foliar-wind -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-wind -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-wind -s V -l version -d 'Print version'
