complete -c foliar-view -s o -l output -d 'Output: .png, or - for standard output' -r -F
complete -c foliar-view -l against -d 'Draws FILE beside it, and what differs' -r -F
complete -c foliar-view -l light-through -d 'Draws a leaf material by itself, both sides lit from behind, with its coefficient maps; with --against beside another bake of it' -r
complete -c foliar-view -l turntable -d 'Draws an animated PNG: the plant turns once in so many pictures, 24 a second' -r
complete -c foliar-view -l sway -d 'Draws an animated PNG: the plant in a storm, 24 pictures a second; with --sheet levels, weights, phases and six times' -r
complete -c foliar-view -l up -d 'Axis of an OBJ that points up; nothing said means y.' -r -f -a "y\t'Y up, as glTF has it.'
z\t'Z up: turned by -90 degrees about X.'"
complete -c foliar-view -l height-m -d 'Height of the plant in meters: an OBJ is scaled to it, instead of `unit`. [meters, above 0]' -r
complete -c foliar-view -l node -d 'Node of a glTF to bake, by name, with everything below it.' -r
complete -c foliar-view -l scene -d 'Scene of a glTF to bake, by number. [at least 0]' -r
complete -c foliar-view -l expand-instances -d 'Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).' -r -f -a "true\t''
false\t''"
complete -c foliar-view -l search -d 'Folders outside the asset\'s own that textures and buffers may be read from.' -r
complete -c foliar-view -l texture -d 'Loose images for parts without one: PART=FILE.' -r
complete -c foliar-view -l leaf -d 'Parts that are leaves.' -r
complete -c foliar-view -l wood -d 'Parts that are wood.' -r
complete -c foliar-view -l other -d 'Parts that are no plant.' -r
complete -c foliar-view -l width-px -d 'Width of the picture in pixels. [pixels, at least 16, at most 8192, default 960]' -r
complete -c foliar-view -l height-px -d 'Height of the picture in pixels; the legend of false colors stands below and adds to it. [pixels, at least 16, at most 8192, default 720]' -r
complete -c foliar-view -l samples -d 'Rays per pixel. [at least 1, at most 1024, default 16]' -r
complete -c foliar-view -l look -d 'How the tree is lit, where no channel is asked for. [default "baked"]' -r -f -a "plain\t'As the file came: its own normals, the same ambient light everywhere.'
baked\t'With what was baked: realigned normals, ambient coefficient.'
stock\t'As any glTF viewer does without foliar\'s shaders: NORMAL turned by the triangle\'s side, `COLOR_0` as a factor on the color, back faces of one-sided materials left out, no shadows on the tree.'
lines\t'A pen drawing: ink where the normals turn by more than `line_angle_deg`, and round the silhouette (Luft07 Figure 7).'
light\t'Sun and sky by what the light room baked (Boulanger08): no shadow rays.'
traced\t'The same light followed path by path, what `light` stands for: a path per ray, so ask for many samples.'"
complete -c foliar-view -l line-normals -d 'Normals that `lines` follow. [default "baked"]' -r -f -a "plain\t'Those of the file.'
baked\t'The realigned ones, where they were baked.'"
complete -c foliar-view -l line-angle-deg -d 'Angle between the normals of neighboring places from which `lines` draw an edge, degrees. [degrees, at least 0, at most 180, default 40.0]' -r
complete -c foliar-view -l line-width-px -d 'Width of `lines` in pixels. [pixels, at least 0.1, at most 16, default 1.2]' -r
complete -c foliar-view -l line-detail-px -d 'Gaps and leaves smaller than this are left out of `lines`, pixels; 0 keeps all. [pixels, at least 0, at most 32, default 6.0]' -r
complete -c foliar-view -l neighbor -d 'Plants that stand around it, `FILE@x,y,z[,yaw_deg[,scale]]` each, as `foliar bake` takes them.' -r
complete -c foliar-view -l channel -d 'Name of a channel or column to show in false colors instead, such as `_AMBIENT` or `foliarLeaf/group`; `_WIND_WEIGHTS[2]` shows its third number alone, `role` what each part was taken for, `petiole-length` how long leaves hang.' -r
complete -c foliar-view -l azimuth-deg -d 'Where the camera stands around the tree, degrees. [degrees, at least -360, at most 360, default 30.0]' -r
complete -c foliar-view -l elevation-deg -d 'How far the camera stands above the tree\'s horizon, degrees. [degrees, at least -89, at most 89, default 10.0]' -r
complete -c foliar-view -l fov-deg -d 'Vertical opening of the camera, degrees. [degrees, at least 1, at most 120, default 30.0]' -r
complete -c foliar-view -l target-m -d 'Point that the camera looks at, `x,y,z` in meters of the scene\'s rest frame; without one the whole plant is in the picture. [meters]' -r
complete -c foliar-view -l distance-m -d 'Distance of the camera from the point that it looks at (the plant\'s center where none is given), meters; without one it stands where it would see the whole plant. [meters, above 0]' -r
complete -c foliar-view -l sun-azimuth-deg -d 'Where the sun stands around the tree, degrees. [degrees, at least -360, at most 360, default 80.0]' -r
complete -c foliar-view -l sun-elevation-deg -d 'Height of the sun above the horizon, degrees. [degrees, at least 1, at most 90, default 50.0]' -r
complete -c foliar-view -l exposure -d 'Factor on all light. [above 0, at most 1000, default 1.0]' -r
complete -c foliar-view -l background -d 'What lies behind the tree. [default "studio"]' -r -f -a "studio\t'A neutral gray gradient.'
white\t'White.'
black\t'Black.'
clear\t'Nothing: alpha 0.'"
complete -c foliar-view -l ground -d 'What lies under the tree. [default "shadow"]' -r -f -a "shadow\t'Only the tree\'s shadow, fading out with distance.'
none\t'Nothing.'"
complete -c foliar-view -l scale -d 'What says how large the plant is. [default "person"]' -r -f -a "person\t'A person of 1.7 m beside plants of about that size or more, and a bar of a round length.'
bar\t'The bar alone.'
none\t'Nothing.'"
complete -c foliar-view -l unit -d 'Unit of length of an OBJ; nothing said means m.' -r -f -a "m\t'Meter.'
cm\t'Centimeter.'
mm\t'Millimeter.'
in\t'Inch.'
ft\t'Foot.'"
complete -c foliar-view -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-view -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-view -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-view -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-view -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-view -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-view -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-view -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-view -l sheet -d 'Draws a contact sheet: plain, baked, difference, ambient coefficient; with --look light two suns by model and by paths'
complete -c foliar-view -l channels -d 'Draws a contact sheet of everything that the file holds, each with its legend'
complete -c foliar-view -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-view -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-view -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-view -s q -l quiet -d 'Prints errors only'
complete -c foliar-view -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-view -s h -l help -d 'Print help (see more with \'--help\')'
complete -c foliar-view -s V -l version -d 'Print version'
