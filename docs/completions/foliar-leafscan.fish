complete -c foliar-leafscan -s o -l output -d 'Output: .exr (every bit), .png (16 bits) of thickness, the other maps beside it; or .layer' -r -F
complete -c foliar-leafscan -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-leafscan -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-leafscan -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-leafscan -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-leafscan -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-leafscan -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-leafscan -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-leafscan -l height-front -d 'Heights of the front, outward, in place of a mesh: PNG of 16 bits, TIFF or EXR.' -r
complete -c foliar-leafscan -l height-back -d 'Heights of the back, outward, texel by texel behind those of the front.' -r
complete -c foliar-leafscan -l resolution -d 'Texels along the longer side of the maps. [at least 8, at most 8192, default 1024]' -r
complete -c foliar-leafscan -l unwrap -d 'Where the maps lie. [default "plane"]' -r -f -a "plane\t'On the plane that the leaf keeps nearest to.'
uv\t'In the mesh\'s own texture coordinates.'"
complete -c foliar-leafscan -l face -d 'Which side is the front, where maps lie on a plane. [default "up"]' -r -f -a "up\t'The one that looks up; of a leaf that stands, the one that looks along +Z.'
down\t'The other.'"
complete -c foliar-leafscan -l smooth-mm -d 'Over how many millimeters the leaf\'s own plane is averaged, in texture coordinates: veins stand out of it, the leaf\'s bend is part of it. [millimeters, at least 0.01, at most 100, default 2.0]' -r
complete -c foliar-leafscan -l texel-mm -d 'Edge of a texel of two height maps, mm; a mesh says that itself. [millimeters, above 0]' -r
complete -c foliar-leafscan -l height-scale-mm -d 'Relief of a height map from black to white, mm; nothing said: 1 for maps of floats. Whole numbers need it. [millimeters, above 0]' -r
complete -c foliar-leafscan -l height-offset-mm -d 'Height where a height map is 0 (black), mm: what a scan says beside its own pictures. [millimeters, default 0.0]' -r
complete -c foliar-leafscan -l gap-mm -d 'Thickness of the leaf where both height maps are 0, mm. [millimeters, at least 0, default 0.0]' -r
complete -c foliar-leafscan -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-leafscan -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-leafscan -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-leafscan -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-leafscan -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-leafscan -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-leafscan -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-leafscan -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-leafscan -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-leafscan -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-leafscan -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-leafscan -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-leafscan -s q -l quiet -d 'Prints errors only'
complete -c foliar-leafscan -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-leafscan -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-leafscan -s V -l version -d 'Print version'
