# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_foliar_global_optspecs
    string join \n h/help V/version
end

function __fish_foliar_needs_command
    # Figure out if the current invocation already has a command.
    set -l cmd (commandline -opc)
    set -e cmd[1]
    argparse -s (__fish_foliar_global_optspecs) -- $cmd 2>/dev/null
    or return
    if set -q argv[1]
        # Also print the command, so this can be used to figure out what it is.
        echo $argv[1]
        return 1
    end
    return 0
end

function __fish_foliar_using_subcommand
    set -l cmd (__fish_foliar_needs_command)
    test -z "$cmd"
    and return 1
    contains -- $cmd[1] $argv
end

complete -c foliar -n "__fish_foliar_needs_command" -s h -l help -d 'Print help'
complete -c foliar -n "__fish_foliar_needs_command" -s V -l version -d 'Print version'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "bake" -d 'Bakes trees all the way: import, structure, every room that the scene needs, one glTF'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "rebake" -d 'Repeats a bake from the records inside the files, in place, starting from what was given'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "assemble" -d 'Puts layer files onto a plant; a layer of the same room is replaced'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "strip" -d 'Takes every layer out of a file again: what comes back is the base'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "config" -d 'Prints every parameter with its value and where that came from'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "inspect" -d 'Prints what a file holds: parts, roles, leaves, channels, records'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "diff" -d 'Says how two bakes differ, channel by channel; status 1 beyond the tolerance'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "explain" -d 'Says what a finding\'s code means, and how serious it is here; without a code, lists all'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "generate" -d 'Writes man pages, shell completions, help texts or JSON schemas into a folder'
complete -c foliar -n "__fish_foliar_needs_command" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -s o -l output -d 'Output: .glb, .gltf, .layer (one room alone), or - for standard output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l picture -d 'Draws what was baked' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l cache -d 'Keeps layers by content: an unchanged room is not baked again' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l leaf -d 'Parts that are leaves.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l wood -d 'Parts that are wood.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l other -d 'Parts that are no plant.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l quality -d 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l neighbor -d 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l only -d 'Bakes this room only, whatever the scene requires; repeatable' -r
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l surface -d 'Writes the closed surface around the foliage (crown hull, collision, impostor); needs no other output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l explain-roles -d 'Prints each part with its role and the evidence; without an output, stops there'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l dry-run -d 'Prints what would be done and stops'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand bake" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -s o -l output -d 'Output: .glb, .gltf, .layer (one room alone), or - for standard output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l picture -d 'Draws what was baked' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l cache -d 'Keeps layers by content: an unchanged room is not baked again' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l leaf -d 'Parts that are leaves.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l wood -d 'Parts that are wood.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l other -d 'Parts that are no plant.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l quality -d 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l neighbor -d 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l explain-roles -d 'Prints each part with its role and the evidence; without an output, stops there'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l dry-run -d 'Prints what would be done and stops'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand rebake" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -s o -l output -d 'Output: .glb, .gltf, or - for standard output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l dry-run -d 'Prints what would be done and stops'
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand assemble" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand strip" -s o -l output -d 'Output: .glb, .gltf, or - for standard output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l dry-run -d 'Prints what would be done and stops'
complete -c foliar -n "__fish_foliar_using_subcommand strip" -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar -n "__fish_foliar_using_subcommand strip" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand strip" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand strip" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand config" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand config" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand config" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l leaf -d 'Parts that are leaves.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l wood -d 'Parts that are wood.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l other -d 'Parts that are no plant.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l quality -d 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l neighbor -d 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand config" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand config" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand config" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand config" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand config" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand config" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand config" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand config" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand config" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand config" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l leaf -d 'Parts that are leaves.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l wood -d 'Parts that are wood.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l other -d 'Parts that are no plant.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l quality -d 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l neighbor -d 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand inspect" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l tolerance -d 'Visible steps that a value may differ by [default: 1]' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand diff" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand diff" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand diff" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand diff" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l require -d 'Rooms or channels that the file must hold: `wind,density`.' -r
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l severity -d 'How serious a code is here: CODE=off, CODE=note, CODE=warning or CODE=error.' -r
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar -n "__fish_foliar_using_subcommand explain" -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar -n "__fish_foliar_using_subcommand explain" -s q -l quiet -d 'Prints errors only'
complete -c foliar -n "__fish_foliar_using_subcommand explain" -s v -l verbose -d 'Prints each step with its time'
complete -c foliar -n "__fish_foliar_using_subcommand explain" -s h -l help -d 'Print help'
complete -c foliar -n "__fish_foliar_using_subcommand generate" -s h -l help -d 'Print help'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "bake" -d 'Bakes trees all the way: import, structure, every room that the scene needs, one glTF'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "rebake" -d 'Repeats a bake from the records inside the files, in place, starting from what was given'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "assemble" -d 'Puts layer files onto a plant; a layer of the same room is replaced'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "strip" -d 'Takes every layer out of a file again: what comes back is the base'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "config" -d 'Prints every parameter with its value and where that came from'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "inspect" -d 'Prints what a file holds: parts, roles, leaves, channels, records'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "diff" -d 'Says how two bakes differ, channel by channel; status 1 beyond the tolerance'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "explain" -d 'Says what a finding\'s code means, and how serious it is here; without a code, lists all'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "generate" -d 'Writes man pages, shell completions, help texts or JSON schemas into a folder'
complete -c foliar -n "__fish_foliar_using_subcommand help; and not __fish_seen_subcommand_from bake rebake assemble strip config inspect diff explain generate help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
