
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-view' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-view'
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
        'foliar-view' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .png, or - for standard output')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .png, or - for standard output')
            [CompletionResult]::new('--against', '--against', [CompletionResultType]::ParameterName, 'Draws FILE beside it, and what differs')
            [CompletionResult]::new('--light-through', '--light-through', [CompletionResultType]::ParameterName, 'Draws a leaf material by itself, both sides lit from behind, with its coefficient maps; with --against beside another bake of it')
            [CompletionResult]::new('--turntable', '--turntable', [CompletionResultType]::ParameterName, 'Draws an animated PNG: the plant turns once in so many pictures, 24 a second')
            [CompletionResult]::new('--sway', '--sway', [CompletionResultType]::ParameterName, 'Draws an animated PNG: the plant in a storm, 24 pictures a second; with --sheet levels, weights, phases and six times')
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
            [CompletionResult]::new('--width-px', '--width-px', [CompletionResultType]::ParameterName, 'Width of the picture in pixels. [pixels, at least 16, at most 8192, default 960]')
            [CompletionResult]::new('--height-px', '--height-px', [CompletionResultType]::ParameterName, 'Height of the picture in pixels; the legend of false colors stands below and adds to it. [pixels, at least 16, at most 8192, default 720]')
            [CompletionResult]::new('--samples', '--samples', [CompletionResultType]::ParameterName, 'Rays per pixel. [at least 1, at most 1024, default 16]')
            [CompletionResult]::new('--look', '--look', [CompletionResultType]::ParameterName, 'How the tree is lit, where no channel is asked for. [default "baked"]')
            [CompletionResult]::new('--line-normals', '--line-normals', [CompletionResultType]::ParameterName, 'Normals that `lines` follow. [default "baked"]')
            [CompletionResult]::new('--line-angle-deg', '--line-angle-deg', [CompletionResultType]::ParameterName, 'Angle between the normals of neighboring places from which `lines` draw an edge, degrees. [degrees, at least 0, at most 180, default 40.0]')
            [CompletionResult]::new('--line-width-px', '--line-width-px', [CompletionResultType]::ParameterName, 'Width of `lines` in pixels. [pixels, at least 0.1, at most 16, default 1.2]')
            [CompletionResult]::new('--line-detail-px', '--line-detail-px', [CompletionResultType]::ParameterName, 'Gaps and leaves smaller than this are left out of `lines`, pixels; 0 keeps all. [pixels, at least 0, at most 32, default 6.0]')
            [CompletionResult]::new('--neighbor', '--neighbor', [CompletionResultType]::ParameterName, 'Plants that stand around it, `FILE@x,y,z[,yaw_deg[,scale]]` each, as `foliar bake` takes them.')
            [CompletionResult]::new('--channel', '--channel', [CompletionResultType]::ParameterName, 'Name of a channel or column to show in false colors instead, such as `_AMBIENT` or `foliarLeaf/group`; `_WIND_WEIGHTS[2]` shows its third number alone, `role` what each part was taken for, `petiole-length` how long leaves hang.')
            [CompletionResult]::new('--azimuth-deg', '--azimuth-deg', [CompletionResultType]::ParameterName, 'Where the camera stands around the tree, degrees. [degrees, at least -360, at most 360, default 30.0]')
            [CompletionResult]::new('--elevation-deg', '--elevation-deg', [CompletionResultType]::ParameterName, 'How far the camera stands above the tree''s horizon, degrees. [degrees, at least -89, at most 89, default 10.0]')
            [CompletionResult]::new('--fov-deg', '--fov-deg', [CompletionResultType]::ParameterName, 'Vertical opening of the camera, degrees. [degrees, at least 1, at most 120, default 30.0]')
            [CompletionResult]::new('--target-m', '--target-m', [CompletionResultType]::ParameterName, 'Point that the camera looks at, `x,y,z` in meters of the scene''s rest frame; without one the whole plant is in the picture. [meters]')
            [CompletionResult]::new('--distance-m', '--distance-m', [CompletionResultType]::ParameterName, 'Distance of the camera from the point that it looks at (the plant''s center where none is given), meters; without one it stands where it would see the whole plant. [meters, above 0]')
            [CompletionResult]::new('--sun-azimuth-deg', '--sun-azimuth-deg', [CompletionResultType]::ParameterName, 'Where the sun stands around the tree, degrees. [degrees, at least -360, at most 360, default 80.0]')
            [CompletionResult]::new('--sun-elevation-deg', '--sun-elevation-deg', [CompletionResultType]::ParameterName, 'Height of the sun above the horizon, degrees. [degrees, at least 1, at most 90, default 50.0]')
            [CompletionResult]::new('--exposure', '--exposure', [CompletionResultType]::ParameterName, 'Factor on all light. [above 0, at most 1000, default 1.0]')
            [CompletionResult]::new('--background', '--background', [CompletionResultType]::ParameterName, 'What lies behind the tree. [default "studio"]')
            [CompletionResult]::new('--ground', '--ground', [CompletionResultType]::ParameterName, 'What lies under the tree. [default "shadow"]')
            [CompletionResult]::new('--scale', '--scale', [CompletionResultType]::ParameterName, 'What says how large the plant is. [default "person"]')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('--sheet', '--sheet', [CompletionResultType]::ParameterName, 'Draws a contact sheet: plain, baked, difference, ambient coefficient; with --look light two suns by model and by paths')
            [CompletionResult]::new('--channels', '--channels', [CompletionResultType]::ParameterName, 'Draws a contact sheet of everything that the file holds, each with its legend')
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
