// Wind of FOLIAR_foliage, to be included in a vertex shader (docs/wind.md explains each step). Rest frame, meters.
// No bindings: tables, noise and attributes are read by whoever includes this. Tests run it against the f64 evaluator.

struct FoliarVertex { position: vec3<f32>, normal: vec3<f32>, tangent: vec3<f32> }

// The branch that a vertex belongs to: level -1 where it does not sway on its own (deeper than the baked levels).
struct FoliarBranch { level: i32, longest_m: f32, frame: vec4<f32>, pivot: vec3<f32> }

// Where to read the noise: four bilinear taps at (low|high).(x|y) make a cubic B-spline, `share` is that of `high`.
struct FoliarTaps { low: vec2<f32>, high: vec2<f32>, share: vec2<f32> }

fn foliar_turn(frame: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    let t = 2.0 * cross(frame.xyz, v);
    return v + frame.w * t + cross(frame.xyz, t);
}

// Where in the noise a branch is. `travel` is folded into [0, 1) on the CPU, in f64.
fn foliar_noise_place(phase: vec2<f32>, travel: vec2<f32>) -> vec2<f32> {
    return fract(phase + travel);
}

fn foliar_taps(place: vec2<f32>, size: f32) -> FoliarTaps {
    let texels = place * size - 0.5;
    let t = fract(texels);
    let u = 1.0 - t;
    let w0 = u * u * u / 6.0;
    let w1 = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
    let w3 = t * t * t / 6.0;
    let share = 1.0 - (w0 + w1);
    let cell = floor(texels) + 0.5;
    return FoliarTaps((cell + w1 / (w0 + w1) - 1.0) / size, (cell + w3 / share + 1.0) / size, share);
}

fn foliar_power(weight: f32, exponent: f32) -> f32 {
    return select(0.0, pow(max(weight, 1e-30), exponent), weight > 0.0);
}

// Displacement of the tip of a branch as long as the longest of its level. Once per branch and frame.
fn foliar_displacement(frame: vec4<f32>, amplitude_m: f32, noise: vec2<f32>, wind: vec3<f32>) -> vec3<f32> {
    let along = foliar_turn(frame, vec3<f32>(0.0, 0.0, 1.0));
    let swing = foliar_turn(frame, vec3<f32>(noise, 0.0));
    return amplitude_m * (swing + wind - along * dot(along, wind));
}

fn foliar_shear(rest: FoliarVertex, position: vec3<f32>, shift: vec3<f32>, gradient: vec3<f32>) -> FoliarVertex {
    let normal = rest.normal * (1.0 + dot(shift, gradient)) - gradient * dot(shift, rest.normal);
    let tangent = rest.tangent + shift * dot(gradient, rest.tangent);
    return FoliarVertex(position, normalize(normal), normalize(tangent));
}

// `chain` holds the displacements of the vertex's branch and its ancestors, level by level; zero where there is none.
fn foliar_bend(
    rest: FoliarVertex, weights: vec4<f32>, exponents: vec4<f32>, chain: array<vec3<f32>, 4>, branch: FoliarBranch,
    keep_length: bool,
) -> FoliarVertex {
    var shifts = chain;
    var own = vec3<f32>(0.0);
    var inherited = vec3<f32>(0.0);
    var slope = 0.0;
    for (var level = 0; level < 4; level++) {
        let shift = shifts[level] * foliar_power(weights[level], exponents[level]);
        if (level == branch.level) {
            own = shift;
            let rising = select(select(0.0, 0.5, exponents[level] <= 1.0),
                foliar_power(weights[level], exponents[level] - 1.0), weights[level] > 0.0);
            slope = select(0.0, exponents[level] * rising / branch.longest_m, branch.longest_m > 0.0);
        } else {
            inherited += shift;
        }
    }
    let calm = abs(shifts[0]) + abs(shifts[1]) + abs(shifts[2]) + abs(shifts[3]);
    if (all(calm == vec3<f32>(0.0))) {
        return rest;
    }
    if (branch.level < 0) {
        return FoliarVertex(rest.position + inherited, rest.normal, rest.tangent);
    }
    var bent = rest.position + own;
    let way = bent - branch.pivot;
    if (keep_length && any(own != vec3<f32>(0.0)) && dot(way, way) > 0.0) {
        bent = branch.pivot + normalize(way) * distance(rest.position, branch.pivot);
    }
    let along = foliar_turn(branch.frame, vec3<f32>(0.0, 0.0, 1.0));
    return foliar_shear(rest, bent + inherited, shifts[branch.level] * slope, along);
}

fn foliar_leaf_noise_place(petiole: vec3<f32>, scale_per_m: f32, roll: vec2<f32>) -> vec2<f32> {
    return fract(petiole.xz * scale_per_m - roll);
}

fn foliar_turn_about_up(v: vec3<f32>, angle: f32) -> vec3<f32> {
    let s = sin(angle);
    let c = cos(angle);
    return vec3<f32>(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}

// A leaf about its petiole, before it moves with its branch. `axis` points from petiole to tip and is as long as that.
fn foliar_flutter(
    rest: FoliarVertex, weight: f32, petiole: vec3<f32>, axis: vec3<f32>, noise: vec2<f32>, wind: vec3<f32>,
    amplitude_m: f32, yaw_rad: f32,
) -> FoliarVertex {
    let reach = dot(axis, axis);
    let unit = axis * select(0.0, inverseSqrt(reach), reach > 0.0);
    let angle = yaw_rad * (unit.z * wind.x - unit.x * wind.z);
    let flat = dot(wind.xz, wind.xz);
    let along = select(vec2<f32>(1.0, 0.0), wind.xz * inverseSqrt(max(flat, 1e-30)), flat > 0.0);
    let swing = amplitude_m * vec3<f32>(along.x * noise.x, noise.y, along.y * noise.x);
    if (angle == 0.0 && all(swing == vec3<f32>(0.0))) {
        return rest;
    }
    let way = rest.position - petiole;
    let moved = foliar_turn_about_up(way, angle) - way + swing * weight;
    let turned = FoliarVertex(
        rest.position, foliar_turn_about_up(rest.normal, angle), foliar_turn_about_up(rest.tangent, angle));
    let gradient = foliar_turn_about_up(axis, angle) * select(0.0, 1.0 / reach, reach > 0.0);
    return foliar_shear(turned, rest.position + moved, swing, gradient);
}
