
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar'
        for ($i = 1; $i -lt $commandElements.Count; $i++) {
            $element = $commandElements[$i]
            if ($element -isnot [StringConstantExpressionAst] -or
                $element.StringConstantType -ne [StringConstantType]::BareWord -or
                $element.Value.StartsWith('-') -or
                $element.Value -eq $wordToComplete) {
                break
        }
        $element.Value
    }) -join ';'

    $completions = @(switch ($command) {
        'foliar' {
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('bake', 'bake', [CompletionResultType]::ParameterValue, 'Bakes trees all the way: import, structure, every room that the scene needs, one glTF')
            [CompletionResult]::new('rebake', 'rebake', [CompletionResultType]::ParameterValue, 'Repeats a bake from the records inside the files, in place, starting from what was given')
            [CompletionResult]::new('assemble', 'assemble', [CompletionResultType]::ParameterValue, 'Puts layer files onto a plant; a layer of the same room is replaced')
            [CompletionResult]::new('strip', 'strip', [CompletionResultType]::ParameterValue, 'Takes every layer out of a file again: what comes back is the base')
            [CompletionResult]::new('config', 'config', [CompletionResultType]::ParameterValue, 'Prints every parameter with its value and where that came from')
            [CompletionResult]::new('inspect', 'inspect', [CompletionResultType]::ParameterValue, 'Prints what a file holds: parts, roles, leaves, channels, records')
            [CompletionResult]::new('diff', 'diff', [CompletionResultType]::ParameterValue, 'Says how two bakes differ, channel by channel; status 1 beyond the tolerance')
            [CompletionResult]::new('explain', 'explain', [CompletionResultType]::ParameterValue, 'Says what a finding''s code means, and how serious it is here; without a code, lists all')
            [CompletionResult]::new('generate', 'generate', [CompletionResultType]::ParameterValue, 'Writes man pages, shell completions, help texts or JSON schemas into a folder')
            [CompletionResult]::new('help', 'help', [CompletionResultType]::ParameterValue, 'Print this message or the help of the given subcommand(s)')
            break
        }
        'foliar;bake' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, .layer (one room alone), or - for standard output')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, .layer (one room alone), or - for standard output')
            [CompletionResult]::new('-d', '-d', [CompletionResultType]::ParameterName, 'Writes DIR/NAME.glb for each input')
            [CompletionResult]::new('--directory', '--directory', [CompletionResultType]::ParameterName, 'Writes DIR/NAME.glb for each input')
            [CompletionResult]::new('--picture', '--picture', [CompletionResultType]::ParameterName, 'Draws what was baked')
            [CompletionResult]::new('--cache', '--cache', [CompletionResultType]::ParameterName, 'Keeps layers by content: an unchanged room is not baked again')
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--leaf', '--leaf', [CompletionResultType]::ParameterName, 'Parts that are leaves.')
            [CompletionResult]::new('--wood', '--wood', [CompletionResultType]::ParameterName, 'Parts that are wood.')
            [CompletionResult]::new('--other', '--other', [CompletionResultType]::ParameterName, 'Parts that are no plant.')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]')
            [CompletionResult]::new('--neighbor', '--neighbor', [CompletionResultType]::ParameterName, 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--only', '--only', [CompletionResultType]::ParameterName, 'Bakes this room only, whatever the scene requires; repeatable')
            [CompletionResult]::new('--surface', '--surface', [CompletionResultType]::ParameterName, 'Writes the closed surface around the foliage (crown hull, collision, impostor); needs no other output')
            [CompletionResult]::new('--keep-going', '--keep-going', [CompletionResultType]::ParameterName, 'Goes on with the other inputs where one fails')
            [CompletionResult]::new('--explain-roles', '--explain-roles', [CompletionResultType]::ParameterName, 'Prints each part with its role and the evidence; without an output, stops there')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('--dry-run', '--dry-run', [CompletionResultType]::ParameterName, 'Prints what would be done and stops')
            [CompletionResult]::new('--check', '--check', [CompletionResultType]::ParameterName, 'Writes nothing; status 1 where the output would change')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;rebake' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, .layer (one room alone), or - for standard output')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, .layer (one room alone), or - for standard output')
            [CompletionResult]::new('-d', '-d', [CompletionResultType]::ParameterName, 'Writes DIR/NAME.glb for each input')
            [CompletionResult]::new('--directory', '--directory', [CompletionResultType]::ParameterName, 'Writes DIR/NAME.glb for each input')
            [CompletionResult]::new('--picture', '--picture', [CompletionResultType]::ParameterName, 'Draws what was baked')
            [CompletionResult]::new('--cache', '--cache', [CompletionResultType]::ParameterName, 'Keeps layers by content: an unchanged room is not baked again')
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--leaf', '--leaf', [CompletionResultType]::ParameterName, 'Parts that are leaves.')
            [CompletionResult]::new('--wood', '--wood', [CompletionResultType]::ParameterName, 'Parts that are wood.')
            [CompletionResult]::new('--other', '--other', [CompletionResultType]::ParameterName, 'Parts that are no plant.')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]')
            [CompletionResult]::new('--neighbor', '--neighbor', [CompletionResultType]::ParameterName, 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--keep-going', '--keep-going', [CompletionResultType]::ParameterName, 'Goes on with the other inputs where one fails')
            [CompletionResult]::new('--explain-roles', '--explain-roles', [CompletionResultType]::ParameterName, 'Prints each part with its role and the evidence; without an output, stops there')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('--dry-run', '--dry-run', [CompletionResultType]::ParameterName, 'Prints what would be done and stops')
            [CompletionResult]::new('--check', '--check', [CompletionResultType]::ParameterName, 'Writes nothing; status 1 where the output would change')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;assemble' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, or - for standard output')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, or - for standard output')
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('--dry-run', '--dry-run', [CompletionResultType]::ParameterName, 'Prints what would be done and stops')
            [CompletionResult]::new('--check', '--check', [CompletionResultType]::ParameterName, 'Writes nothing; status 1 where the output would change')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;strip' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, or - for standard output')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, or - for standard output')
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('--dry-run', '--dry-run', [CompletionResultType]::ParameterName, 'Prints what would be done and stops')
            [CompletionResult]::new('--check', '--check', [CompletionResultType]::ParameterName, 'Writes nothing; status 1 where the output would change')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;config' {
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--leaf', '--leaf', [CompletionResultType]::ParameterName, 'Parts that are leaves.')
            [CompletionResult]::new('--wood', '--wood', [CompletionResultType]::ParameterName, 'Parts that are wood.')
            [CompletionResult]::new('--other', '--other', [CompletionResultType]::ParameterName, 'Parts that are no plant.')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]')
            [CompletionResult]::new('--neighbor', '--neighbor', [CompletionResultType]::ParameterName, 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;inspect' {
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--leaf', '--leaf', [CompletionResultType]::ParameterName, 'Parts that are leaves.')
            [CompletionResult]::new('--wood', '--wood', [CompletionResultType]::ParameterName, 'Parts that are wood.')
            [CompletionResult]::new('--other', '--other', [CompletionResultType]::ParameterName, 'Parts that are no plant.')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview. [above 0, default 1.0]')
            [CompletionResult]::new('--neighbor', '--neighbor', [CompletionResultType]::ParameterName, 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;diff' {
            [CompletionResult]::new('--tolerance', '--tolerance', [CompletionResultType]::ParameterName, 'Visible steps that a value may differ by [default: 1]')
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'foliar;explain' {
            [CompletionResult]::new('--require', '--require', [CompletionResultType]::ParameterName, 'Rooms or channels that the file must hold: `wind,density`.')
            [CompletionResult]::new('--severity', '--severity', [CompletionResultType]::ParameterName, 'How serious a code is here: CODE=off, CODE=note, CODE=warning or CODE=error.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            break
        }
        'foliar;generate' {
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            break
        }
        'foliar;help' {
            [CompletionResult]::new('bake', 'bake', [CompletionResultType]::ParameterValue, 'Bakes trees all the way: import, structure, every room that the scene needs, one glTF')
            [CompletionResult]::new('rebake', 'rebake', [CompletionResultType]::ParameterValue, 'Repeats a bake from the records inside the files, in place, starting from what was given')
            [CompletionResult]::new('assemble', 'assemble', [CompletionResultType]::ParameterValue, 'Puts layer files onto a plant; a layer of the same room is replaced')
            [CompletionResult]::new('strip', 'strip', [CompletionResultType]::ParameterValue, 'Takes every layer out of a file again: what comes back is the base')
            [CompletionResult]::new('config', 'config', [CompletionResultType]::ParameterValue, 'Prints every parameter with its value and where that came from')
            [CompletionResult]::new('inspect', 'inspect', [CompletionResultType]::ParameterValue, 'Prints what a file holds: parts, roles, leaves, channels, records')
            [CompletionResult]::new('diff', 'diff', [CompletionResultType]::ParameterValue, 'Says how two bakes differ, channel by channel; status 1 beyond the tolerance')
            [CompletionResult]::new('explain', 'explain', [CompletionResultType]::ParameterValue, 'Says what a finding''s code means, and how serious it is here; without a code, lists all')
            [CompletionResult]::new('generate', 'generate', [CompletionResultType]::ParameterValue, 'Writes man pages, shell completions, help texts or JSON schemas into a folder')
            [CompletionResult]::new('help', 'help', [CompletionResultType]::ParameterValue, 'Print this message or the help of the given subcommand(s)')
            break
        }
        'foliar;help;bake' {
            break
        }
        'foliar;help;rebake' {
            break
        }
        'foliar;help;assemble' {
            break
        }
        'foliar;help;strip' {
            break
        }
        'foliar;help;config' {
            break
        }
        'foliar;help;inspect' {
            break
        }
        'foliar;help;diff' {
            break
        }
        'foliar;help;explain' {
            break
        }
        'foliar;help;generate' {
            break
        }
        'foliar;help;help' {
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
