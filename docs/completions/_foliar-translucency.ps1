
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'foliar-translucency' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'foliar-translucency'
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
        'foliar-translucency' {
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
            [CompletionResult]::new('--thickness', '--thickness', [CompletionResultType]::ParameterName, 'Map of thickness, `FILE` or `MATERIAL=FILE`: white is `thickness_scale_mm`; floats are millimeters.')
            [CompletionResult]::new('--alpha', '--alpha', [CompletionResultType]::ParameterName, 'Map of where the leaf is, `FILE` or `MATERIAL=FILE`; nothing given: the alpha of the thickness map or of the material''s own color, else wherever the thickness is above 0.')
            [CompletionResult]::new('--normal-front', '--normal-front', [CompletionResultType]::ParameterName, 'Normal map of the front, `FILE` or `MATERIAL=FILE`: light from there shows on the back.')
            [CompletionResult]::new('--normal-back', '--normal-back', [CompletionResultType]::ParameterName, 'Normal map of the back, `FILE` or `MATERIAL=FILE`: light from there shows on the front.')
            [CompletionResult]::new('--height-front', '--height-front', [CompletionResultType]::ParameterName, 'Height map of the front in place of its normals, `FILE` or `MATERIAL=FILE`.')
            [CompletionResult]::new('--height-back', '--height-back', [CompletionResultType]::ParameterName, 'Height map of the back, outward from it, `FILE` or `MATERIAL=FILE`.')
            [CompletionResult]::new('--backlit', '--backlit', [CompletionResultType]::ParameterName, 'Photograph of the leaf against the light, PNG or JPEG, `FILE` or `MATERIAL=FILE`: the color of what comes through, passed on as it is. Without one it is estimated from the base color.')
            [CompletionResult]::new('--material', '--material', [CompletionResultType]::ParameterName, 'Leaf materials that maps without a name belong to (`*leaf*`, case ignored); nothing given: the only one that there is.')
            [CompletionResult]::new('--for-material', '--for-material', [CompletionResultType]::ParameterName, 'What differs for one material, `MATERIAL:KEY=VALUE` each, KEY of this section: `Needle*:leaf_width_mm=2`.')
            [CompletionResult]::new('--leaf-width-mm', '--leaf-width-mm', [CompletionResultType]::ParameterName, 'Width of the map on the leaf, mm; this or `texel_mm` must be given: light spreads in millimeters. [millimeters, above 0]')
            [CompletionResult]::new('--texel-mm', '--texel-mm', [CompletionResultType]::ParameterName, 'Edge of a texel on the leaf, mm. [millimeters, above 0]')
            [CompletionResult]::new('--texel-height-mm', '--texel-height-mm', [CompletionResultType]::ParameterName, 'The other edge of it, down the image, mm; nothing said: texels are square. [millimeters, above 0]')
            [CompletionResult]::new('--thickness-scale-mm', '--thickness-scale-mm', [CompletionResultType]::ParameterName, 'Thickness of the leaf where the map is 1 (white), less the offset, mm; nothing said: 1 for maps of floats, which hold millimeters. Whole numbers need it. [millimeters, above 0]')
            [CompletionResult]::new('--thickness-offset-mm', '--thickness-offset-mm', [CompletionResultType]::ParameterName, 'Thickness of the leaf where the map is 0, mm. [millimeters, default 0.0]')
            [CompletionResult]::new('--thickness-from', '--thickness-from', [CompletionResultType]::ParameterName, 'What the thickness map is. [default "map"]')
            [CompletionResult]::new('--thickness-mean-mm', '--thickness-mean-mm', [CompletionResultType]::ParameterName, 'Mean thickness of a photographed leaf, mm; nothing said: that of the kind of leaf. [millimeters, above 0]')
            [CompletionResult]::new('--veins', '--veins', [CompletionResultType]::ParameterName, 'How veins look in a photograph. [default "auto"]')
            [CompletionResult]::new('--height-scale-mm', '--height-scale-mm', [CompletionResultType]::ParameterName, 'Relief of a height map from black to white, mm; nothing said: 1 for maps of floats. Whole numbers need it. [millimeters, above 0]')
            [CompletionResult]::new('--preset', '--preset', [CompletionResultType]::ParameterName, 'Kind of leaf. [default "typical"]')
            [CompletionResult]::new('--wavelength-nm', '--wavelength-nm', [CompletionResultType]::ParameterName, 'Wavelength, nm: 510 as in the paper; a leaf''s green peak is at 550. [nanometers, at least 450, at most 680, default 510.0]')
            [CompletionResult]::new('--bands', '--bands', [CompletionResultType]::ParameterName, 'One wavelength or three. [default "one"]')
            [CompletionResult]::new('--absorption', '--absorption', [CompletionResultType]::ParameterName, 'Absorption, 1/mm; nothing said: that of `preset`. [at least 0]')
            [CompletionResult]::new('--reduced-scattering', '--reduced-scattering', [CompletionResultType]::ParameterName, 'Reduced scattering, 1/mm; nothing said: that of `preset`. [at least 0]')
            [CompletionResult]::new('--anisotropy', '--anisotropy', [CompletionResultType]::ParameterName, 'Mean cosine of scattering. [at least -0.95, at most 0.999, default 0.8]')
            [CompletionResult]::new('--index', '--index', [CompletionResultType]::ParameterName, 'Index of refraction; nothing said: that of `preset`. [at least 1, at most 4]')
            [CompletionResult]::new('--fit-rt', '--fit-rt', [CompletionResultType]::ParameterName, 'Measured reflectance and transmittance, `R,T`, of a leaf as thick as the median of the map: absorption and scattering follow from them. For `bands = "rgb"` three of them, of red, green and blue: `R,T;R,T;R,T`.')
            [CompletionResult]::new('--mirror', '--mirror', [CompletionResultType]::ParameterName, 'Whether the measured reflectance holds the surface''s mirror. [default "included"]')
            [CompletionResult]::new('--layer', '--layer', [CompletionResultType]::ParameterName, 'Layers of tissue from the front, `ABSORPTION,REDUCED,ANISOTROPY,SHARE` each, shares of the thickness; nothing said: one tissue.')
            [CompletionResult]::new('--model', '--model', [CompletionResultType]::ParameterName, 'Where energy comes from. [default "adding-doubling"]')
            [CompletionResult]::new('--entry', '--entry', [CompletionResultType]::ParameterName, 'How light enters. [default "transport"]')
            [CompletionResult]::new('--fit', '--fit', [CompletionResultType]::ParameterName, 'How the fit weighs directions. [default "uniform"]')
            [CompletionResult]::new('--curve', '--curve', [CompletionResultType]::ParameterName, 'Whether two numbers bend the linear answer. [default "straight"]')
            [CompletionResult]::new('--spread', '--spread', [CompletionResultType]::ParameterName, 'Whether light spreads inside the leaf. [default "kernel"]')
            [CompletionResult]::new('--filters', '--filters', [CompletionResultType]::ParameterName, 'Filters of the bank that stands for the spread, the identity among them; without it as many as keep the bank within .3 % rms of the direct gather: 6 on a map of 1024 texels, 8 on one of 4096. [at least 2, at most 12]')
            [CompletionResult]::new('--normalize', '--normalize', [CompletionResultType]::ParameterName, 'What the map is divided by. [default "none"]')
            [CompletionResult]::new('--sides', '--sides', [CompletionResultType]::ParameterName, 'Sides that maps are made for. [default "both"]')
            [CompletionResult]::new('--normal-frame', '--normal-frame', [CompletionResultType]::ParameterName, 'In which frame the back''s normal map was baked. [default "same-uv-mirrored"]')
            [CompletionResult]::new('--normal-y', '--normal-y', [CompletionResultType]::ParameterName, 'Which way green points in normal maps. [default "up"]')
            [CompletionResult]::new('--coarsest-mm', '--coarsest-mm', [CompletionResultType]::ParameterName, 'Edge up to which texels of the baked maps are merged, two by two, mm; nothing said: none. A scene implies the size of a pixel at its nearest distance. [millimeters, above 0]')
            [CompletionResult]::new('--exr', '--exr', [CompletionResultType]::ParameterName, 'Numbers of the EXR beside the file. [default "half"]')
            [CompletionResult]::new('--embed-all', '--embed-all', [CompletionResultType]::ParameterName, 'Whether every map goes into the file, in 8 bits, and none beside it.')
            [CompletionResult]::new('--unit', '--unit', [CompletionResultType]::ParameterName, 'Unit of length of an OBJ; nothing said means m.')
            [CompletionResult]::new('--set', '--set', [CompletionResultType]::ParameterName, 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all')
            [CompletionResult]::new('--config', '--config', [CompletionResultType]::ParameterName, 'Reads this configuration instead of the project''s foliar.toml')
            [CompletionResult]::new('--outputs', '--outputs', [CompletionResultType]::ParameterName, 'Writes the list of files that belong to the output')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what was read, found, made and measured')
            [CompletionResult]::new('--depfile', '--depfile', [CompletionResultType]::ParameterName, 'Writes every file that was really read, as a rule for make or ninja')
            [CompletionResult]::new('--fail-on', '--fail-on', [CompletionResultType]::ParameterName, 'Findings as serious as this end the work with status 1, the old output left as it is')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Works in so many threads; the result is the same for any number')
            [CompletionResult]::new('--format', '--format', [CompletionResultType]::ParameterName, 'How results are printed: for people, as JSON lines, or the findings for machines that show them')
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, .layer or - with a tree; without one .exr (with a PNG and a JSON beside it), .png, .layer or -')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Output: .glb, .gltf, .layer or - with a tree; without one .exr (with a PNG and a JSON beside it), .png, .layer or -')
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
