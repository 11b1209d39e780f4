// Wind of FOLIAR_foliage, to be included in a vertex shader (docs/wind.md explains each step). Rest frame, meters.
// No bindings: tables, noise and attributes are read by whoever includes this. Tests run it against the f64 evaluator.

struct FoliarVertex { vec3 position; vec3 normal; vec3 tangent; };

// The branch that a vertex belongs to: level -1 where it does not sway on its own (deeper than the baked levels).
struct FoliarBranch { int level; float longest_m; vec4 frame; vec3 pivot; };

// Where to read the noise: four bilinear taps at (low|high).(x|y) make a cubic B-spline, `share` is that of `high`.
struct FoliarTaps { vec2 low; vec2 high; vec2 share; };

vec3 foliar_turn(vec4 frame, vec3 v) {
    vec3 t = 2.0 * cross(frame.xyz, v);
    return v + frame.w * t + cross(frame.xyz, t);
}

// Where in the noise a branch is. `travel` is folded into [0, 1) on the CPU, in f64.
vec2 foliar_noise_place(vec2 phase, vec2 travel) {
    return fract(phase + travel);
}

FoliarTaps foliar_taps(vec2 place, float size) {
    vec2 texels = place * size - 0.5;
    vec2 t = fract(texels);
    vec2 u = 1.0 - t;
    vec2 w0 = u * u * u / 6.0;
    vec2 w1 = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
    vec2 w3 = t * t * t / 6.0;
    vec2 share = 1.0 - (w0 + w1);
    vec2 cell = floor(texels) + 0.5;
    return FoliarTaps((cell + w1 / (w0 + w1) - 1.0) / size, (cell + w3 / share + 1.0) / size, share);
}

float foliar_power(float weight, float exponent) {
    return weight > 0.0 ? pow(weight, exponent) : 0.0;
}

// Displacement of the tip of a branch as long as the longest of its level. Once per branch and frame.
vec3 foliar_displacement(vec4 frame, float amplitude_m, vec2 noise, vec3 wind) {
    vec3 along = foliar_turn(frame, vec3(0.0, 0.0, 1.0));
    vec3 swing = foliar_turn(frame, vec3(noise, 0.0));
    return amplitude_m * (swing + wind - along * dot(along, wind));
}

FoliarVertex foliar_shear(FoliarVertex rest, vec3 position, vec3 shift, vec3 gradient) {
    vec3 normal = rest.normal * (1.0 + dot(shift, gradient)) - gradient * dot(shift, rest.normal);
    vec3 tangent = rest.tangent + shift * dot(gradient, rest.tangent);
    return FoliarVertex(position, normalize(normal), normalize(tangent));
}

// `chain` holds the displacements of the vertex's branch and its ancestors, level by level; zero where there is none.
FoliarVertex foliar_bend(
    FoliarVertex rest, vec4 weights, vec4 exponents, vec3 chain[4], FoliarBranch branch, bool keep_length
) {
    vec3 own = vec3(0.0);
    vec3 inherited = vec3(0.0);
    vec3 leaning = vec3(0.0);
    for (int level = 0; level < 4; level++) {
        vec3 shift = chain[level] * foliar_power(weights[level], exponents[level]);
        if (level == branch.level) {
            own = shift;
            float rising = weights[level] > 0.0 ? foliar_power(weights[level], exponents[level] - 1.0)
                : (exponents[level] <= 1.0 ? 0.5 : 0.0);
            leaning = branch.longest_m > 0.0 ? chain[level] * (exponents[level] * rising / branch.longest_m) : vec3(0.0);
        } else {
            inherited += shift;
        }
    }
    if (abs(chain[0]) + abs(chain[1]) + abs(chain[2]) + abs(chain[3]) == vec3(0.0)) {
        return rest;
    }
    if (branch.level < 0) {
        return FoliarVertex(rest.position + inherited, rest.normal, rest.tangent);
    }
    vec3 bent = rest.position + own;
    vec3 way = bent - branch.pivot;
    if (keep_length && own != vec3(0.0) && dot(way, way) > 0.0) {
        bent = branch.pivot + normalize(way) * distance(rest.position, branch.pivot);
    }
    vec3 along = foliar_turn(branch.frame, vec3(0.0, 0.0, 1.0));
    return foliar_shear(rest, bent + inherited, leaning, along);
}

vec2 foliar_leaf_noise_place(vec3 petiole, float scale_per_m, vec2 roll) {
    return fract(petiole.xz * scale_per_m - roll);
}

vec3 foliar_turn_about_up(vec3 v, float angle) {
    float s = sin(angle);
    float c = cos(angle);
    return vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}

// A leaf about its petiole, before it moves with its branch. `axis` points from petiole to tip and is as long as that.
FoliarVertex foliar_flutter(
    FoliarVertex rest, float weight, vec3 petiole, vec3 axis, vec2 noise, vec3 wind, float amplitude_m, float yaw_rad
) {
    float reach = dot(axis, axis);
    vec3 unit = reach > 0.0 ? axis * inversesqrt(reach) : vec3(0.0);
    float angle = yaw_rad * (unit.z * wind.x - unit.x * wind.z);
    float flatness = dot(wind.xz, wind.xz);
    vec2 along = flatness > 0.0 ? wind.xz * inversesqrt(flatness) : vec2(1.0, 0.0);
    vec3 swing = amplitude_m * vec3(along.x * noise.x, noise.y, along.y * noise.x);
    if (angle == 0.0 && swing == vec3(0.0)) {
        return rest;
    }
    vec3 way = rest.position - petiole;
    vec3 moved = foliar_turn_about_up(way, angle) - way + swing * weight;
    FoliarVertex turned =
        FoliarVertex(rest.position, foliar_turn_about_up(rest.normal, angle), foliar_turn_about_up(rest.tangent, angle));
    vec3 gradient = reach > 0.0 ? foliar_turn_about_up(axis, angle) / reach : vec3(0.0);
    return foliar_shear(turned, rest.position + moved, swing, gradient);
}
