
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-light' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-light'
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
        'foliar-light' {
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
            [CompletionResult]::new('--engine', '--engine', [CompletionResultType]::ParameterName, 'How optical depths are found. [default "auto"]')
            [CompletionResult]::new('--profile', '--profile', [CompletionResultType]::ParameterName, 'How leaves are counted. [default "cap"]')
            [CompletionResult]::new('--opening', '--opening', [CompletionResultType]::ParameterName, 'For `tree`: leaves stand together where they spread less than this times their distance; nothing said: as `quality` allows. [above 0, at most 0.9]')
            [CompletionResult]::new('--rays', '--rays', [CompletionResultType]::ParameterName, 'For rays: how many in each octant. [at least 1, at most 4096, default 16]')
            [CompletionResult]::new('--sun', '--sun', [CompletionResultType]::ParameterName, 'What the run-time model knows of the sun''s light. [default "octants"]')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'Error of the transmittance of an octant, rms over 4,096 places, in its visible steps: 1 cannot be seen, 4 is a preview; nothing said: what the scene asks for. [above 0]')
            [CompletionResult]::new('--leaf-kind', '--leaf-kind', [CompletionResultType]::ParameterName, 'Kind of leaf: what it reflects and lets through. [default "typical"]')
            [CompletionResult]::new('--reflectance-front', '--reflectance-front', [CompletionResultType]::ParameterName, 'Reflectance of the front, one number or red, green, blue; none: that of `leaf_kind`.')
            [CompletionResult]::new('--reflectance-back', '--reflectance-back', [CompletionResultType]::ParameterName, 'Reflectance of the back.')
            [CompletionResult]::new('--transmittance-front', '--transmittance-front', [CompletionResultType]::ParameterName, 'Share of the light on the front that leaves on the back.')
            [CompletionResult]::new('--transmittance-back', '--transmittance-back', [CompletionResultType]::ParameterName, 'Share of the light on the back that leaves on the front.')
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
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
