
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-leafscan' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-leafscan'
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
        'foliar-leafscan' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .exr (every bit), .png (16 bits) of thickness, the other maps beside it; or .layer')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .exr (every bit), .png (16 bits) of thickness, the other maps beside it; or .layer')
            [CompletionResult]::new('--up', '--up', [CompletionResultType]::ParameterName, 'Axis of an OBJ that points up; nothing said means y.')
            [CompletionResult]::new('--height-m', '--height-m', [CompletionResultType]::ParameterName, 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]')
            [CompletionResult]::new('--node', '--node', [CompletionResultType]::ParameterName, 'Node of a glTF to bake, by name, with everything below it.')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Scene of a glTF to bake, by number. [at least 0]')
            [CompletionResult]::new('--expand-instances', '--expand-instances', [CompletionResultType]::ParameterName, 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).')
            [CompletionResult]::new('--search', '--search', [CompletionResultType]::ParameterName, 'Folders outside the asset''s own that textures and buffers may be read from.')
            [CompletionResult]::new('--texture', '--texture', [CompletionResultType]::ParameterName, 'Loose images for parts without one: PART=FILE.')
            [CompletionResult]::new('--height-front', '--height-front', [CompletionResultType]::ParameterName, 'Heights of the front, outward, in place of a mesh: PNG of 16 bits, TIFF or EXR.')
            [CompletionResult]::new('--height-back', '--height-back', [CompletionResultType]::ParameterName, 'Heights of the back, outward, texel by texel behind those of the front.')
            [CompletionResult]::new('--resolution', '--resolution', [CompletionResultType]::ParameterName, 'Texels along the longer side of the maps. [at least 8, at most 8192, default 1024]')
            [CompletionResult]::new('--unwrap', '--unwrap', [CompletionResultType]::ParameterName, 'Where the maps lie. [default "plane"]')
            [CompletionResult]::new('--face', '--face', [CompletionResultType]::ParameterName, 'Which side is the front, where maps lie on a plane. [default "up"]')
            [CompletionResult]::new('--smooth-mm', '--smooth-mm', [CompletionResultType]::ParameterName, 'Over how many millimeters the leaf''s own plane is averaged, in texture coordinates: veins stand out of it, the leaf''s bend is part of it. [millimeters, at least 0.01, at most 100, default 2.0]')
            [CompletionResult]::new('--texel-mm', '--texel-mm', [CompletionResultType]::ParameterName, 'Edge of a texel of two height maps, mm; a mesh says that itself. [millimeters, above 0]')
            [CompletionResult]::new('--height-scale-mm', '--height-scale-mm', [CompletionResultType]::ParameterName, 'Relief of a height map from black to white, mm; nothing said: 1 for maps of floats. Whole numbers need it. [millimeters, above 0]')
            [CompletionResult]::new('--height-offset-mm', '--height-offset-mm', [CompletionResultType]::ParameterName, 'Height where a height map is 0 (black), mm: what a scan says beside its own pictures. [millimeters, default 0.0]')
            [CompletionResult]::new('--gap-mm', '--gap-mm', [CompletionResultType]::ParameterName, 'Thickness of the leaf where both height maps are 0, mm. [millimeters, at least 0, default 0.0]')
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
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
