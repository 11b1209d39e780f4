
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-check' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-check'
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
        'foliar-check' {
            [CompletionResult]::new('--after', '--after', [CompletionResultType]::ParameterName, 'Checks what another tool made of --master, and says what it lost')
            [CompletionResult]::new('--master', '--master', [CompletionResultType]::ParameterName, 'The file that the checked ones were made from')
            [CompletionResult]::new('--baseline', '--baseline', [CompletionResultType]::ParameterName, 'Leaves out the findings that this file lists')
            [CompletionResult]::new('--write-baseline', '--write-baseline', [CompletionResultType]::ParameterName, 'Writes everything that was found as a baseline; status 0')
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
            [CompletionResult]::new('--require', '--require', [CompletionResultType]::ParameterName, 'Rooms or channels that the file must hold: `wind,density`.')
            [CompletionResult]::new('--severity', '--severity', [CompletionResultType]::ParameterName, 'How serious a code is here: CODE=off, CODE=note, CODE=warning or CODE=error.')
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
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
