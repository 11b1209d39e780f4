complete -c foliar-check -l after -d 'Checks what another tool made of --master, and says what it lost' -r -F
complete -c foliar-check -l master -d 'The file that the checked ones were made from' -r -F
complete -c foliar-check -l baseline -d 'Leaves out the findings that this file lists' -r -F
complete -c foliar-check -l write-baseline -d 'Writes everything that was found as a baseline; status 0' -r -F
complete -c foliar-check -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-check -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-check -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-check -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-check -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-check -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-check -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-check -l leaf -d 'Parts that are leaves.' -r
complete -c foliar-check -l wood -d 'Parts that are wood.' -r
complete -c foliar-check -l other -d 'Parts that are no plant.' -r
complete -c foliar-check -l require -d 'Rooms or channels that the file must hold: `wind,density`.' -r
complete -c foliar-check -l severity -d 'How serious a code is here: CODE=off, CODE=note, CODE=warning or CODE=error.' -r
complete -c foliar-check -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-check -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-check -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-check -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-check -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-check -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-check -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-check -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-check -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-check -s q -l quiet -d 'Prints errors only'
complete -c foliar-check -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-check -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-check -s V -l version -d 'Print version'
