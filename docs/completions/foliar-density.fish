complete -c foliar-density -s o -l output -d 'Output: .glb, .gltf, .layer (one room alone), or - for standard output' -r -F
complete -c foliar-density -s d -l directory -d 'Writes DIR/NAME.glb for each input' -r -F
complete -c foliar-density -l picture -d 'Draws what was baked' -r -F
complete -c foliar-density -l cache -d 'Keeps layers by content: an unchanged room is not baked again' -r -F
complete -c foliar-density -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-density -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-density -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-density -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-density -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-density -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-density -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-density -l leaf -d 'Parts that are leaves.' -r
complete -c foliar-density -l wood -d 'Parts that are wood.' -r
complete -c foliar-density -l other -d 'Parts that are no plant.' -r
complete -c foliar-density -l radius-m -d 'Radius of influence of a leaf, meters (Luft07 eq. 2); nothing said: from the crown\'s size and the number of its leaves. [meters, above 0]' -r
complete -c foliar-density -l threshold -d 'Density below which a place counts as outside, in units of `density_unit` (tau of Luft07 eq. 3). [at least 0, default 0.1]' -r
complete -c foliar-density -l darkest-density -d 'Density above the threshold from which a place is darkest, in units of `density_unit` (d_min of Luft07 eq. 4). [above 0, default 2.0]' -r
complete -c foliar-density -l density-unit -d 'Unit of `threshold` and `darkest_density`. [default "median"]' -r -f -a "median\t'The plant\'s own median density: the same numbers suit any tree.'
absolute\t'Density at the center of a mean leaf alone, as the paper has it: to be found by hand for each tree.'"
complete -c foliar-density -l darkest-ambient -d 'Ambient coefficient of the darkest places (k_min of Luft07 eq. 4). [at least 0, at most 1, default 0.1]' -r
complete -c foliar-density -l exponent -d 'How fast light falls off with density (n of Luft07 eq. 4). [above 0, default 3.0]' -r
complete -c foliar-density -l self -d 'Whether a leaf\'s own group counts in the density at its vertices. [default "exclude"]' -r -f -a "exclude\t'All but the leaf\'s own group: a lone leaf is fully lit.'
include\t'All, as the paper sums: a lone leaf shades itself.'"
complete -c foliar-density -l ambient -d 'Ambient term: `luft` or `sky`. [default "sky"]' -r -f -a "luft\t'k_a of the local density (Luft07 eq. 4).'
sky\t'Transmittance to the sky, averaged over all directions (Beer-Lambert through the density field).'"
complete -c foliar-density -l generators -d 'What one metaball stands for. [default "leaf"]' -r -f -a "leaf\t'A leaf, weighted by its area with alpha (mean weight 1).'
leaf-count\t'A leaf, every one with weight 1.'
primitive\t'A triangle of the foliage, every one with weight 1, as the paper has it: a leaf that is cut into more triangles gets denser.'"
complete -c foliar-density -l subsample -d 'Share of the metaballs that count, chosen at random (Luft07 section 5): faster and coarser. [above 0, at most 1, default 1.0]' -r
complete -c foliar-density -l normals -d 'Where realigned normals come from. [default "sky"]' -r -f -a "sky\t'Mean direction to the sky, each direction weighted by the light that comes through: our own.'
surface\t'Normal of the closest point of the implicit surface, cavities left out (Luft07 section 4).'"
complete -c foliar-density -l channels -d 'Which channels are written. [default "both"]' -r -f -a "both\t'`_AMBIENT` and `_SOFT_NORMAL`.'
ambient\t'`_AMBIENT` only.'
normals\t'`_SOFT_NORMAL` only.'"
complete -c foliar-density -l quality -d 'Error of each channel, rms over 4,096 places, in its visible steps: 1 cannot be seen, 4 is a preview; nothing said: what the scene asks for. [above 0]' -r
complete -c foliar-density -l neighbor -d 'Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.' -r
complete -c foliar-density -l blend -d 'Share of the original normal in the realigned one (Luft07 section 4). [at least 0, at most 1, default 0.0]' -r
complete -c foliar-density -l surface-cell-m -d 'Edge of a cell of the implicit surface, meters; nothing said: a quarter of the radius of influence. [meters, above 0]' -r
complete -c foliar-density -l surface-memory-mb -d 'Most memory that the implicit surface and its making may take, megabytes. [above 0, default 4096.0]' -r
complete -c foliar-density -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-density -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-density -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-density -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-density -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-density -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-density -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-density -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-density -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-density -l surface -d 'Writes the closed surface around the foliage (crown hull, collision, impostor); needs no other output' -r -F
complete -c foliar-density -l keep-going -d 'Goes on with the other inputs where one fails'
complete -c foliar-density -l explain-roles -d 'Prints each part with its role and the evidence; without an output, stops there'
complete -c foliar-density -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-density -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-density -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-density -s q -l quiet -d 'Prints errors only'
complete -c foliar-density -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-density -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-density -s V -l version -d 'Print version'
