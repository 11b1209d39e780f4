complete -c foliar-translucency -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar-translucency -l picture -d 'Draws what was baked' -r -F
complete -c foliar-translucency -l cache -d 'Keeps layers by content: an unchanged room is not baked again' -r -F
complete -c foliar-translucency -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-translucency -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-translucency -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-translucency -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-translucency -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-translucency -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-translucency -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-translucency -l leaf -d 'Parts that are leaves.' -r
complete -c foliar-translucency -l wood -d 'Parts that are wood.' -r
complete -c foliar-translucency -l other -d 'Parts that are no plant.' -r
complete -c foliar-translucency -l thickness -d 'Map of thickness, `FILE` or `MATERIAL=FILE`: white is `thickness_scale_mm`; floats are millimeters.' -r
complete -c foliar-translucency -l alpha -d 'Map of where the leaf is, `FILE` or `MATERIAL=FILE`; nothing given: the alpha of the thickness map or of the material\'s own color, else wherever the thickness is above 0.' -r
complete -c foliar-translucency -l normal-front -d 'Normal map of the front, `FILE` or `MATERIAL=FILE`: light from there shows on the back.' -r
complete -c foliar-translucency -l normal-back -d 'Normal map of the back, `FILE` or `MATERIAL=FILE`: light from there shows on the front.' -r
complete -c foliar-translucency -l height-front -d 'Height map of the front in place of its normals, `FILE` or `MATERIAL=FILE`.' -r
complete -c foliar-translucency -l height-back -d 'Height map of the back, outward from it, `FILE` or `MATERIAL=FILE`.' -r
complete -c foliar-translucency -l backlit -d 'Photograph of the leaf against the light, PNG or JPEG, `FILE` or `MATERIAL=FILE`: the color of what comes through, passed on as it is. Without one it is estimated from the base color.' -r
complete -c foliar-translucency -l material -d 'Leaf materials that maps without a name belong to (`*leaf*`, case ignored); nothing given: the only one that there is.' -r
complete -c foliar-translucency -l for-material -d 'What differs for one material, `MATERIAL:KEY=VALUE` each, KEY of this section: `Needle*:leaf_width_mm=2`.' -r
complete -c foliar-translucency -l leaf-width-mm -d 'Width of the map on the leaf, mm; this or `texel_mm` must be given: light spreads in millimeters. [millimeters, above 0]' -r
complete -c foliar-translucency -l texel-mm -d 'Edge of a texel on the leaf, mm. [millimeters, above 0]' -r
complete -c foliar-translucency -l texel-height-mm -d 'The other edge of it, down the image, mm; nothing said: texels are square. [millimeters, above 0]' -r
complete -c foliar-translucency -l thickness-scale-mm -d 'Thickness of the leaf where the map is 1 (white), less the offset, mm; nothing said: 1 for maps of floats, which hold millimeters. Whole numbers need it. [millimeters, above 0]' -r
complete -c foliar-translucency -l thickness-offset-mm -d 'Thickness of the leaf where the map is 0, mm. [millimeters, default 0.0]' -r
complete -c foliar-translucency -l thickness-from -d 'What the thickness map is. [default "map"]' -r -f -a "map\t'Thickness, measured or painted.'
photo\t'A photograph in color with alpha: thickness is estimated, veins thick, rim thin, the mean as `thickness_mean_mm` says.'"
complete -c foliar-translucency -l thickness-mean-mm -d 'Mean thickness of a photographed leaf, mm; nothing said: that of the kind of leaf. [millimeters, above 0]' -r
complete -c foliar-translucency -l veins -d 'How veins look in a photograph. [default "auto"]' -r -f -a "auto\t'Whichever stands out more.'
light\t'Lighter than the blade: most leaves from their front.'
dark\t'Darker: backlit leaves.'"
complete -c foliar-translucency -l height-scale-mm -d 'Relief of a height map from black to white, mm; nothing said: 1 for maps of floats. Whole numbers need it. [millimeters, above 0]' -r
complete -c foliar-translucency -l preset -d 'Kind of leaf. [default "typical"]' -r -f -a "typical\t'A green leaf of .2 mm.'
young\t'Thin and light green, .12 mm.'
dark\t'Thick and dark, .3 mm.'
senescent\t'Yellow, .2 mm.'"
complete -c foliar-translucency -l wavelength-nm -d 'Wavelength, nm: 510 as in the paper; a leaf\'s green peak is at 550. [nanometers, at least 450, at most 680, default 510.0]' -r
complete -c foliar-translucency -l bands -d 'One wavelength or three. [default "one"]' -r -f -a "one\t'One, `wavelength_nm`.'
rgb\t'Three maps a side: 610, 550 and 450 nm.'"
complete -c foliar-translucency -l absorption -d 'Absorption, 1/mm; nothing said: that of `preset`. [at least 0]' -r
complete -c foliar-translucency -l reduced-scattering -d 'Reduced scattering, 1/mm; nothing said: that of `preset`. [at least 0]' -r
complete -c foliar-translucency -l anisotropy -d 'Mean cosine of scattering. [at least -0.95, at most 0.999, default 0.8]' -r
complete -c foliar-translucency -l index -d 'Index of refraction; nothing said: that of `preset`. [at least 1, at most 4]' -r
complete -c foliar-translucency -l fit-rt -d 'Measured reflectance and transmittance, `R,T`, of a leaf as thick as the median of the map: absorption and scattering follow from them. For `bands = "rgb"` three of them, of red, green and blue: `R,T;R,T;R,T`.' -r
complete -c foliar-translucency -l mirror -d 'Whether the measured reflectance holds the surface\'s mirror. [default "included"]' -r -f -a "included\t'It does.'
excluded\t'It was left out.'"
complete -c foliar-translucency -l layer -d 'Layers of tissue from the front, `ABSORPTION,REDUCED,ANISOTROPY,SHARE` each, shares of the thickness; nothing said: one tissue.' -r
complete -c foliar-translucency -l model -d 'Where energy comes from. [default "adding-doubling"]' -r -f -a "multipole\t'The image series in closed form, as the paper had it; its shape too.'
diffusion\t'Delta-P1.'
adding-doubling\t'Adding-doubling; the shape is delta-P1\'s.'"
complete -c foliar-translucency -l entry -d 'How light enters. [default "transport"]' -r -f -a "lambert\t'The cosine alone, as Kusternig07 has it: slanting light is overestimated, by 30 to 110 % at 70 degrees.'
fresnel\t'Cosine and the surface\'s mirror.'
transport\t'Cosine, mirror, and the way of the refracted ray through the leaf.'"
complete -c foliar-translucency -l fit -d 'How the fit weighs directions. [default "uniform"]' -r -f -a "uniform\t'All alike.'
cosine\t'By their cosine: better from ahead, worse from the side.'
anchor\t'Exact from straight ahead; else all alike.'"
complete -c foliar-translucency -l curve -d 'Whether two numbers bend the linear answer. [default "straight"]' -r -f -a "straight\t'No: any viewer of three coefficients shows the map.'
fitted\t'Yes: a viewer must multiply by a0 + a1 l_z, which the record tells. Errors fall by a third to six tenths.'"
complete -c foliar-translucency -l spread -d 'Whether light spreads inside the leaf. [default "kernel"]' -r -f -a "none\t'Each texel for itself.'
kernel\t'By the kernel of the thickness where it leaves.'"
complete -c foliar-translucency -l filters -d 'Filters of the bank that stands for the spread, the identity among them; without it as many as keep the bank within .3 % rms of the direct gather: 6 on a map of 1024 texels, 8 on one of 4096. [at least 2, at most 12]' -r
complete -c foliar-translucency -l normalize -d 'What the map is divided by. [default "none"]' -r -f -a "none\t'Nothing: physical.'
mean\t'Its mean under diffuse light.'
diffuse\t'Each texel by its own answer to diffuse light: only direction is left, for a leaf whose backlit photograph holds the rest.'"
complete -c foliar-translucency -l sides -d 'Sides that maps are made for. [default "both"]' -r -f -a "front\t'Shown on the front, lit from the back.'
back\t'Shown on the back, lit from the front.'
both\t'Both.'"
complete -c foliar-translucency -l normal-frame -d 'In which frame the back\'s normal map was baked. [default "same-uv-mirrored"]' -r -f -a "same-uv-mirrored\t'On the front\'s texture coordinates: x is the image\'s right on both sides.'
right-handed\t'In a right-handed frame of the back: its x points to the image\'s left.'"
complete -c foliar-translucency -l normal-y -d 'Which way green points in normal maps. [default "up"]' -r -f -a "up\t'To the image\'s top (OpenGL, glTF).'
down\t'To its bottom (DirectX).'"
complete -c foliar-translucency -l coarsest-mm -d 'Edge up to which texels of the baked maps are merged, two by two, mm; nothing said: none. A scene implies the size of a pixel at its nearest distance. [millimeters, above 0]' -r
complete -c foliar-translucency -l exr -d 'Numbers of the EXR beside the file. [default "half"]' -r -f -a "half\t'16 bits: right to .05 %.'
float\t'32 bits.'"
complete -c foliar-translucency -l embed-all -d 'Whether every map goes into the file, in 8 bits, and none beside it.' -r -f -a "true\t''
false\t''"
complete -c foliar-translucency -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-translucency -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-translucency -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-translucency -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-translucency -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-translucency -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-translucency -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-translucency -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-translucency -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-translucency -s o -l output -d 'Output: .glb, .gltf, .layer or - with a tree; without one .exr (with a PNG and a JSON beside it), .png, .layer or -' -r -F
complete -c foliar-translucency -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar-translucency -l explain-roles -d 'Prints each part with its role and the evidence; without an output, stops there'
complete -c foliar-translucency -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-translucency -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-translucency -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-translucency -s q -l quiet -d 'Prints errors only'
complete -c foliar-translucency -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-translucency -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-translucency -s V -l version -d 'Print version'
