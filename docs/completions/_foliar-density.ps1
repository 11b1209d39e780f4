
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-density' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-density'
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
        'foliar-density' {
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
            [CompletionResult]::new('--radius-m', '--radius-m', [CompletionResultType]::ParameterName, 'Radius of influence of a leaf, meters (Luft07 eq. 2); nothing said: from the crown''s size and the number of its leaves. [meters, above 0]')
            [CompletionResult]::new('--threshold', '--threshold', [CompletionResultType]::ParameterName, 'Density below which a place counts as outside, in units of `density_unit` (tau of Luft07 eq. 3). [at least 0, default 0.1]')
            [CompletionResult]::new('--darkest-density', '--darkest-density', [CompletionResultType]::ParameterName, 'Density above the threshold from which a place is darkest, in units of `density_unit` (d_min of Luft07 eq. 4). [above 0, default 2.0]')
            [CompletionResult]::new('--density-unit', '--density-unit', [CompletionResultType]::ParameterName, 'Unit of `threshold` and `darkest_density`. [default "median"]')
            [CompletionResult]::new('--darkest-ambient', '--darkest-ambient', [CompletionResultType]::ParameterName, 'Ambient coefficient of the darkest places (k_min of Luft07 eq. 4). [at least 0, at most 1, default 0.1]')
            [CompletionResult]::new('--exponent', '--exponent', [CompletionResultType]::ParameterName, 'How fast light falls off with density (n of Luft07 eq. 4). [above 0, default 3.0]')
            [CompletionResult]::new('--self', '--self', [CompletionResultType]::ParameterName, 'Whether a leaf''s own group counts in the density at its vertices. [default "exclude"]')
            [CompletionResult]::new('--ambient', '--ambient', [CompletionResultType]::ParameterName, 'Ambient term: `luft` or `sky`. [default "sky"]')
            [CompletionResult]::new('--generators', '--generators', [CompletionResultType]::ParameterName, 'What one metaball stands for. [default "leaf"]')
            [CompletionResult]::new('--subsample', '--subsample', [CompletionResultType]::ParameterName, 'Share of the metaballs that count, chosen at random (Luft07 section 5): faster and coarser. [above 0, at most 1, default 1.0]')
            [CompletionResult]::new('--normals', '--normals', [CompletionResultType]::ParameterName, 'Where realigned normals come from. [default "sky"]')
            [CompletionResult]::new('--channels', '--channels', [CompletionResultType]::ParameterName, 'Which channels are written. [default "both"]')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'Error of each channel, rms over 4,096 places, in its visible steps: 1 cannot be seen, 4 is a preview; nothing said: what the scene asks for. [above 0]')
            [CompletionResult]::new('--neighbor', '--neighbor', [CompletionResultType]::ParameterName, 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.')
            [CompletionResult]::new('--blend', '--blend', [CompletionResultType]::ParameterName, 'Share of the original normal in the realigned one (Luft07 section 4). [at least 0, at most 1, default 0.0]')
            [CompletionResult]::new('--surface-cell-m', '--surface-cell-m', [CompletionResultType]::ParameterName, 'Edge of a cell of the implicit surface, meters; nothing said: a quarter of the radius of influence. [meters, above 0]')
            [CompletionResult]::new('--surface-memory-mb', '--surface-memory-mb', [CompletionResultType]::ParameterName, 'Most memory that the implicit surface and its making may take, megabytes. [above 0, default 4096.0]')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
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
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
