
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-noise' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-noise'
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
        'foliar-noise' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .png (16 bits), .exr (every bit), .layer, or - for a PNG on standard output')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .png (16 bits), .exr (every bit), .layer, or - for a PNG on standard output')
            [CompletionResult]::new('--beta', '--beta', [CompletionResultType]::ParameterName, 'Slope of the power spectrum in time, 1/f^beta: 1 is pink, 2 is brown. A straight way through a field in the plane has the power of the field less one, so the field itself falls with beta + 1. [at least 0.5, at most 4, default 2.0]')
            [CompletionResult]::new('--size', '--size', [CompletionResultType]::ParameterName, 'Texels along each edge. [at least 32, at most 2048, default 256]')
            [CompletionResult]::new('--kmin', '--kmin', [CompletionResultType]::ParameterName, 'Lowest waves per tile: 2 or 3 where one row alone would look periodic. [at least 1, at most 64, default 1]')
            [CompletionResult]::new('--kmax', '--kmax', [CompletionResultType]::ParameterName, 'Highest waves per tile, below half the size: times tiles per second it is the fastest sway in hertz. Near half the size, filtering between texels loses much of it. [at least 8, at most 1024, default 32]')
            [CompletionResult]::new('--seed', '--seed', [CompletionResultType]::ParameterName, 'Which of all such textures. [at least 0, at most 4294967295, default 1]')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--measure', '--measure', [CompletionResultType]::ParameterName, 'Prints what was measured on it')
            [CompletionResult]::new('--no-config', '--no-config', [CompletionResultType]::ParameterName, 'Reads neither foliar.toml nor the asset''s own file')
            [CompletionResult]::new('--dry-run', '--dry-run', [CompletionResultType]::ParameterName, 'Prints what would be done and stops')
            [CompletionResult]::new('--check', '--check', [CompletionResultType]::ParameterName, 'Writes nothing; status 1 where the output would change')
            [CompletionResult]::new('-q', '-q', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('--quiet', '--quiet', [CompletionResultType]::ParameterName, 'Prints errors only')
            [CompletionResult]::new('-v', '-v', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('--verbose', '--verbose', [CompletionResultType]::ParameterName, 'Prints each step with its time')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
