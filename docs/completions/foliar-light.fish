complete -c foliar-light -s o -l output -d 'Output: .glb, .gltf, .layer (one room alone), or - for standard output' -r -F
complete -c foliar-light -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar-light -l picture -d 'Draws what was baked' -r -F
complete -c foliar-light -l cache -d 'Keeps layers by content: an unchanged room is not baked again' -r -F
complete -c foliar-light -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-light -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-light -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-light -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-light -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-light -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-light -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-light -l leaf -d 'Parts that are leaves.' -r
complete -c foliar-light -l wood -d 'Parts that are wood.' -r
complete -c foliar-light -l other -d 'Parts that are no plant.' -r
complete -c foliar-light -l engine -d 'How optical depths are found. [default "auto"]' -r -f -a "auto\t'`exact` or `tree`, whatever keeps the promise of `quality` in less time.'
exact\t'Every leaf against every other.'
tree\t'Leaves that are far stand together.'
rays\t'Rays from points on the leaf: sees the shape of leaves, their cut-outs, and wood; many times as slow as `tree`.'"
complete -c foliar-light -l profile -d 'How leaves are counted. [default "cap"]' -r -f -a "cap\t'A leaf is a sphere cap, and lies in several octants where it crosses their borders.'
paper\t'As the paper has it: half the leaf\'s area over the squared distance, all in the octant of its center.'"
complete -c foliar-light -l opening -d 'For `tree`: leaves stand together where they spread less than this times their distance; nothing said: as `quality` allows. [above 0, at most 0.9]' -r
complete -c foliar-light -l rays -d 'For rays: how many in each octant. [at least 1, at most 4096, default 16]' -r
complete -c foliar-light -l sun -d 'What the run-time model knows of the sun\'s light. [default "octants"]' -r -f -a "octants\t'What the eight octants say.'
harmonics\t'Nine coefficients of transmittance more (spherical harmonics of order 2), from rays: shadows are sharper.'"
complete -c foliar-light -l quality -d 'Error of the transmittance of an octant, rms over 4,096 places, in its visible steps: 1 cannot be seen, 4 is a preview; nothing said: what the scene asks for. [above 0]' -r
complete -c foliar-light -l leaf-kind -d 'Kind of leaf: what it reflects and lets through. [default "typical"]' -r -f -a "typical\t'A broad leaf in summer.'
young\t'A thin leaf in spring.'
dark\t'A thick leaf, much chlorophyll.'
senescent\t'A leaf in autumn.'"
complete -c foliar-light -l reflectance-front -d 'Reflectance of the front, one number or red, green, blue; none: that of `leaf_kind`.' -r
complete -c foliar-light -l reflectance-back -d 'Reflectance of the back.' -r
complete -c foliar-light -l transmittance-front -d 'Share of the light on the front that leaves on the back.' -r
complete -c foliar-light -l transmittance-back -d 'Share of the light on the back that leaves on the front.' -r
complete -c foliar-light -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-light -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-light -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-light -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-light -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-light -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-light -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-light -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-light -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-light -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar-light -l explain-roles -d 'Prints each part with its role and the evidence; without an output, stops there'
complete -c foliar-light -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-light -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-light -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-light -s q -l quiet -d 'Prints errors only'
complete -c foliar-light -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-light -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-light -s V -l version -d 'Print version'
