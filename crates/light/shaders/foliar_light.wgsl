// Light of a leaf from eight optical depths (FOLIAR_foliage, docs/light.md). No bindings: the application fetches the row of
// foliarLight (or _LIGHT_DEPTH_0/1) and passes it in. Octants in the order of the file: x > 0 is bit 0, z > 0 bit 1,
// y > 0 bit 2; component k of the two vectors is octant k and 4 + k.

// Values of the eight octants: the four of the ground, the four of the sky.
struct FoliarOctants { low: vec4<f32>, high: vec4<f32> }

// What the octants are to the sun: once per frame, on either processor.
struct FoliarSun {
    toward: vec3<f32>,
    weights: FoliarOctants,
    fading: FoliarOctants,
    // Bounced light for leaves that scatter 1, and that pass 1.
    scattered: FoliarOctants,
    passed: FoliarOctants,
}

// Share of light onto a side that comes back, and that goes through, in linear red, green, blue; r + t at most 1.
struct FoliarOptics { r_front: vec3<f32>, r_back: vec3<f32>, t_front: vec3<f32>, t_back: vec3<f32> }

// Irradiance, or radiance, of both sides of a leaf. The front is where its normal points.
struct FoliarSides { front: vec3<f32>, back: vec3<f32> }

// Mean radiance of each octant of the surroundings.
struct FoliarSky { octants: array<vec3<f32>, 8> }

const FOLIAR_PI: f32 = 3.14159265358979;
const FOLIAR_MIDDLE: f32 = 0.577350269189626;
const FOLIAR_MOST_DEPTH: f32 = 16.0;

fn foliar_sum(o: FoliarOctants) -> f32 {
    return dot(o.low + o.high, vec4<f32>(1.0));
}

fn foliar_dot(a: FoliarOctants, b: FoliarOctants) -> f32 {
    return dot(a.low, b.low) + dot(a.high, b.high);
}

fn foliar_middle_cosines(v: vec3<f32>) -> FoliarOctants {
    let level = FOLIAR_MIDDLE * vec4<f32>(-v.x - v.z, v.x - v.z, v.z - v.x, v.x + v.z);
    let rise = FOLIAR_MIDDLE * v.y;
    return FoliarOctants(level - rise, level + rise);
}

// `toward` is the unit vector to the sun.
fn foliar_light_sun(toward: vec3<f32>) -> FoliarSun {
    let cosines = foliar_middle_cosines(toward);
    let positive = FoliarOctants(max(cosines.low, vec4<f32>(0.0)), max(cosines.high, vec4<f32>(0.0)));
    let sum = foliar_sum(positive);
    let w = FoliarOctants(positive.low / sum, positive.high / sum);
    let both = w.low + w.high;
    let rise = dot(w.high - w.low, vec4<f32>(1.0));
    let mean = FOLIAR_MIDDLE * vec3<f32>(both.y + both.w - both.x - both.z, rise, both.z + both.w - both.x - both.y);
    let fading = foliar_middle_cosines(mean);
    let low = clamp(cosines.low, vec4<f32>(-1.0), vec4<f32>(1.0));
    let high = clamp(cosines.high, vec4<f32>(-1.0), vec4<f32>(1.0));
    let share = 1.0 / (6.0 * FOLIAR_PI);
    return FoliarSun(
        toward,
        w,
        FoliarOctants(1.0 - fading.low, 1.0 - fading.high),
        FoliarOctants(
            share * (sqrt(1.0 - low * low) - acos(low) * low),
            share * (sqrt(1.0 - high * high) - acos(high) * high)),
        FoliarOctants(share * FOLIAR_PI * low, share * FOLIAR_PI * high));
}

fn foliar_depths(depths: FoliarOctants) -> FoliarOctants {
    let most = vec4<f32>(FOLIAR_MOST_DEPTH);
    return FoliarOctants(min(depths.low, most), min(depths.high, most));
}

fn foliar_transmittances(depths: FoliarOctants) -> FoliarOctants {
    let d = foliar_depths(depths);
    return FoliarOctants(exp(-d.low), exp(-d.high));
}

// Integral of the cosine to `n` (unit) over an octant, `n` seen from +x, +y, +z.
fn foliar_octant_cosine(n: vec3<f32>) -> f32 {
    let low = min(min(n.x, n.y), n.z);
    let high = max(max(n.x, n.y), n.z);
    let middle = max(min(n.x, n.y), min(max(n.x, n.y), n.z));
    if (low >= 0.0) { return 0.25 * FOLIAR_PI * (low + middle + high); }
    if (high <= 0.0) { return 0.0; }
    if (middle >= 0.0) {
        let rest = (middle * middle + high * high) / (1.0 - low);
        let arcs = middle * atan2(high, -low) + high * atan2(middle, -low) - atan2(middle * high, -low);
        return max(0.5 * arcs + 0.25 * FOLIAR_PI * rest, 0.0);
    }
    let arcs = atan2(high, low * middle) + middle * atan2(high, -low) + low * atan2(high, -middle);
    return max(0.5 * arcs, 0.0);
}

// The eight integrals; together pi.
fn foliar_octant_cosines(n: vec3<f32>) -> FoliarOctants {
    return FoliarOctants(
        vec4<f32>(
            foliar_octant_cosine(n * vec3<f32>(-1.0, -1.0, -1.0)), foliar_octant_cosine(n * vec3<f32>(1.0, -1.0, -1.0)),
            foliar_octant_cosine(n * vec3<f32>(-1.0, -1.0, 1.0)), foliar_octant_cosine(n * vec3<f32>(1.0, -1.0, 1.0))),
        vec4<f32>(
            foliar_octant_cosine(n * vec3<f32>(-1.0, 1.0, -1.0)), foliar_octant_cosine(n * vec3<f32>(1.0, 1.0, -1.0)),
            foliar_octant_cosine(n * vec3<f32>(-1.0, 1.0, 1.0)), foliar_octant_cosine(n)));
}

// Transmittance toward the sun from the eight depths.
fn foliar_sun_transmittance(depths: FoliarOctants, sun: FoliarSun) -> f32 {
    return foliar_dot(sun.weights, foliar_transmittances(depths));
}

// The same from the nine numbers of sunSh: 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2.
fn foliar_sun_transmittance_sh(sh: array<f32, 9>, toward: vec3<f32>) -> f32 {
    let d = toward;
    let sum = 0.282094791773878 * sh[0]
        + 0.488602511902920 * (sh[1] * d.y + sh[2] * d.z + sh[3] * d.x)
        + 1.092548430592079 * (sh[4] * d.x * d.y + sh[5] * d.y * d.z + sh[7] * d.x * d.z)
        + 0.315391565252520 * sh[6] * (3.0 * d.z * d.z - 1.0)
        + 0.546274215296040 * sh[8] * (d.x * d.x - d.y * d.y);
    return clamp(sum, 0.0, 1.0);
}

// (1 - exp(-x)) / x; near 0, where that cancels, its series.
fn foliar_mean_decay(x: vec4<f32>) -> vec4<f32> {
    let series = 1.0 - x * (0.5 - x * (0.166666667 - x * (0.0416666667 - x * 0.00833333333)));
    let exact = (1.0 - exp(-x)) / max(x, vec4<f32>(0.05));
    return mix(exact, series, step(x, vec4<f32>(0.1)));
}

// Light that a bounce brings from each octant, over the optics.
fn foliar_slices(depths: FoliarOctants, fading: FoliarOctants) -> FoliarOctants {
    let d = foliar_depths(depths);
    return FoliarOctants(d.low * foliar_mean_decay(fading.low * d.low), d.high * foliar_mean_decay(fading.high * d.high));
}

fn foliar_side(
    k: FoliarOctants, facing: f32, transmittance: f32, sun_light: vec3<f32>, sky: FoliarSky, t: FoliarOctants,
    bounced: vec2<f32>, optics: FoliarOptics,
) -> vec3<f32> {
    let passed = optics.t_front + optics.t_back;
    let scattered = optics.r_front + optics.r_back + passed;
    let albedo = min(0.5 * scattered, vec3<f32>(1.0));
    let escape = foliar_sum(t) / 8.0;
    let bounces = 1.0 / ((1.0 - albedo) + albedo * escape);
    let from_sky = k.low.x * t.low.x * sky.octants[0] + k.low.y * t.low.y * sky.octants[1]
        + k.low.z * t.low.z * sky.octants[2] + k.low.w * t.low.w * sky.octants[3]
        + k.high.x * t.high.x * sky.octants[4] + k.high.y * t.high.y * sky.octants[5]
        + k.high.z * t.high.z * sky.octants[6] + k.high.w * t.high.w * sky.octants[7];
    let from_leaves = (scattered * bounced.x + passed * bounced.y) * (2.0 / FOLIAR_PI);
    return sun_light * transmittance * (max(facing, 0.0) + bounces * from_leaves) + from_sky * bounces;
}

// Irradiance of both sides of a leaf from sun and sky, all bounces. `transmittance` toward the sun is one of the two above,
// `sun_light` the irradiance of a surface that faces the sun.
fn foliar_light(
    depths: FoliarOctants, normal: vec3<f32>, optics: FoliarOptics, sun: FoliarSun, transmittance: f32,
    sun_light: vec3<f32>, sky: FoliarSky,
) -> FoliarSides {
    let t = foliar_transmittances(depths);
    let slices = foliar_slices(depths, sun.fading);
    let a = FoliarOctants(slices.low * sun.scattered.low, slices.high * sun.scattered.high);
    let b = FoliarOctants(slices.low * sun.passed.low, slices.high * sun.passed.high);
    let front = foliar_octant_cosines(normal);
    let back = foliar_octant_cosines(-normal);
    let facing = dot(normal, sun.toward);
    return FoliarSides(
        foliar_side(front, facing, transmittance, sun_light, sky, t, vec2<f32>(foliar_dot(front, a), foliar_dot(front, b)), optics),
        foliar_side(back, -facing, transmittance, sun_light, sky, t, vec2<f32>(foliar_dot(back, a), foliar_dot(back, b)), optics));
}

// Radiance that leaves both sides under an irradiance of both.
fn foliar_radiance(light: FoliarSides, optics: FoliarOptics) -> FoliarSides {
    return FoliarSides(
        (optics.r_front * light.front + optics.t_back * light.back) / FOLIAR_PI,
        (optics.r_back * light.back + optics.t_front * light.front) / FOLIAR_PI);
}
