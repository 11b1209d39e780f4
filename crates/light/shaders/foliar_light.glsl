// Light of a leaf from eight optical depths (FOLIAR_foliage, docs/light.md). No bindings: the application fetches the row of
// foliarLight (or _LIGHT_DEPTH_0/1) and passes it in. Octants in the order of the file: x > 0 is bit 0, z > 0 bit 1,
// y > 0 bit 2; component k of the two vectors is octant k and 4 + k.

// Values of the eight octants: the four of the ground, the four of the sky.
struct FoliarOctants { vec4 low; vec4 high; };

// What the octants are to the sun: once per frame, on either processor.
struct FoliarSun {
    vec3 toward;
    FoliarOctants weights;
    FoliarOctants fading;
    // Bounced light for leaves that scatter 1, and that pass 1.
    FoliarOctants scattered;
    FoliarOctants passed;
};

// Share of light onto a side that comes back, and that goes through, in linear red, green, blue; r + t at most 1.
struct FoliarOptics { vec3 r_front; vec3 r_back; vec3 t_front; vec3 t_back; };

// Irradiance, or radiance, of both sides of a leaf. The front is where its normal points.
struct FoliarSides { vec3 front; vec3 back; };

// Mean radiance of each octant of the surroundings.
struct FoliarSky { vec3 octants[8]; };

const float FOLIAR_PI = 3.14159265358979;
const float FOLIAR_MIDDLE = 0.577350269189626;
const float FOLIAR_MOST_DEPTH = 16.0;

float foliar_sum(FoliarOctants o) {
    return dot(o.low + o.high, vec4(1.0));
}

float foliar_dot(FoliarOctants a, FoliarOctants b) {
    return dot(a.low, b.low) + dot(a.high, b.high);
}

FoliarOctants foliar_middle_cosines(vec3 v) {
    vec4 level = FOLIAR_MIDDLE * vec4(-v.x - v.z, v.x - v.z, v.z - v.x, v.x + v.z);
    float rise = FOLIAR_MIDDLE * v.y;
    return FoliarOctants(level - rise, level + rise);
}

// `toward` is the unit vector to the sun.
FoliarSun foliar_light_sun(vec3 toward) {
    FoliarOctants cosines = foliar_middle_cosines(toward);
    FoliarOctants positive = FoliarOctants(max(cosines.low, vec4(0.0)), max(cosines.high, vec4(0.0)));
    float sum = foliar_sum(positive);
    FoliarOctants w = FoliarOctants(positive.low / sum, positive.high / sum);
    vec4 both = w.low + w.high;
    float rise = dot(w.high - w.low, vec4(1.0));
    vec3 mean = FOLIAR_MIDDLE * vec3(both.y + both.w - both.x - both.z, rise, both.z + both.w - both.x - both.y);
    FoliarOctants fading = foliar_middle_cosines(mean);
    vec4 low = clamp(cosines.low, vec4(-1.0), vec4(1.0));
    vec4 high = clamp(cosines.high, vec4(-1.0), vec4(1.0));
    float share = 1.0 / (6.0 * FOLIAR_PI);
    return FoliarSun(
        toward,
        w,
        FoliarOctants(1.0 - fading.low, 1.0 - fading.high),
        FoliarOctants(
            share * (sqrt(1.0 - low * low) - acos(low) * low),
            share * (sqrt(1.0 - high * high) - acos(high) * high)),
        FoliarOctants(share * FOLIAR_PI * low, share * FOLIAR_PI * high));
}

FoliarOctants foliar_depths(FoliarOctants depths) {
    vec4 most = vec4(FOLIAR_MOST_DEPTH);
    return FoliarOctants(min(depths.low, most), min(depths.high, most));
}

FoliarOctants foliar_transmittances(FoliarOctants depths) {
    FoliarOctants d = foliar_depths(depths);
    return FoliarOctants(exp(-d.low), exp(-d.high));
}

// Integral of the cosine to `n` (unit) over an octant, `n` seen from +x, +y, +z.
float foliar_octant_cosine(vec3 n) {
    float low = min(min(n.x, n.y), n.z);
    float high = max(max(n.x, n.y), n.z);
    float middle = max(min(n.x, n.y), min(max(n.x, n.y), n.z));
    if (low >= 0.0) return 0.25 * FOLIAR_PI * (low + middle + high);
    if (high <= 0.0) return 0.0;
    if (middle >= 0.0) {
        float rest = (middle * middle + high * high) / (1.0 - low);
        float arcs = middle * atan(high, -low) + high * atan(middle, -low) - atan(middle * high, -low);
        return max(0.5 * arcs + 0.25 * FOLIAR_PI * rest, 0.0);
    }
    float arcs = atan(high, low * middle) + middle * atan(high, -low) + low * atan(high, -middle);
    return max(0.5 * arcs, 0.0);
}

// The eight integrals; together pi.
FoliarOctants foliar_octant_cosines(vec3 n) {
    return FoliarOctants(
        vec4(
            foliar_octant_cosine(n * vec3(-1.0, -1.0, -1.0)), foliar_octant_cosine(n * vec3(1.0, -1.0, -1.0)),
            foliar_octant_cosine(n * vec3(-1.0, -1.0, 1.0)), foliar_octant_cosine(n * vec3(1.0, -1.0, 1.0))),
        vec4(
            foliar_octant_cosine(n * vec3(-1.0, 1.0, -1.0)), foliar_octant_cosine(n * vec3(1.0, 1.0, -1.0)),
            foliar_octant_cosine(n * vec3(-1.0, 1.0, 1.0)), foliar_octant_cosine(n)));
}

// Transmittance toward the sun from the eight depths.
float foliar_sun_transmittance(FoliarOctants depths, FoliarSun sun) {
    return foliar_dot(sun.weights, foliar_transmittances(depths));
}

// The same from the nine numbers of sunSh: 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2.
float foliar_sun_transmittance_sh(float sh[9], vec3 toward) {
    vec3 d = toward;
    float sum = 0.282094791773878 * sh[0]
        + 0.488602511902920 * (sh[1] * d.y + sh[2] * d.z + sh[3] * d.x)
        + 1.092548430592079 * (sh[4] * d.x * d.y + sh[5] * d.y * d.z + sh[7] * d.x * d.z)
        + 0.315391565252520 * sh[6] * (3.0 * d.z * d.z - 1.0)
        + 0.546274215296040 * sh[8] * (d.x * d.x - d.y * d.y);
    return clamp(sum, 0.0, 1.0);
}

// (1 - exp(-x)) / x; near 0, where that cancels, its series.
vec4 foliar_mean_decay(vec4 x) {
    vec4 series = 1.0 - x * (0.5 - x * (0.166666667 - x * (0.0416666667 - x * 0.00833333333)));
    vec4 exact = (1.0 - exp(-x)) / max(x, vec4(0.05));
    return mix(exact, series, step(x, vec4(0.1)));
}

// Light that a bounce brings from each octant, over the optics.
FoliarOctants foliar_slices(FoliarOctants depths, FoliarOctants fading) {
    FoliarOctants d = foliar_depths(depths);
    return FoliarOctants(d.low * foliar_mean_decay(fading.low * d.low), d.high * foliar_mean_decay(fading.high * d.high));
}

vec3 foliar_side(
    FoliarOctants k, float facing, float transmittance, vec3 sun_light, FoliarSky sky, FoliarOctants t,
    vec2 bounced, FoliarOptics optics
) {
    vec3 passed = optics.t_front + optics.t_back;
    vec3 scattered = optics.r_front + optics.r_back + passed;
    vec3 albedo = min(0.5 * scattered, vec3(1.0));
    float escape = foliar_sum(t) / 8.0;
    vec3 bounces = 1.0 / ((1.0 - albedo) + albedo * escape);
    vec3 from_sky = k.low.x * t.low.x * sky.octants[0] + k.low.y * t.low.y * sky.octants[1]
        + k.low.z * t.low.z * sky.octants[2] + k.low.w * t.low.w * sky.octants[3]
        + k.high.x * t.high.x * sky.octants[4] + k.high.y * t.high.y * sky.octants[5]
        + k.high.z * t.high.z * sky.octants[6] + k.high.w * t.high.w * sky.octants[7];
    vec3 from_leaves = (scattered * bounced.x + passed * bounced.y) * (2.0 / FOLIAR_PI);
    return sun_light * transmittance * (max(facing, 0.0) + bounces * from_leaves) + from_sky * bounces;
}

// Irradiance of both sides of a leaf from sun and sky, all bounces. `transmittance` toward the sun is one of the two above,
// `sun_light` the irradiance of a surface that faces the sun.
FoliarSides foliar_light(
    FoliarOctants depths, vec3 normal, FoliarOptics optics, FoliarSun sun, float transmittance,
    vec3 sun_light, FoliarSky sky
) {
    FoliarOctants t = foliar_transmittances(depths);
    FoliarOctants slices = foliar_slices(depths, sun.fading);
    FoliarOctants a = FoliarOctants(slices.low * sun.scattered.low, slices.high * sun.scattered.high);
    FoliarOctants b = FoliarOctants(slices.low * sun.passed.low, slices.high * sun.passed.high);
    FoliarOctants front = foliar_octant_cosines(normal);
    FoliarOctants back = foliar_octant_cosines(-normal);
    float facing = dot(normal, sun.toward);
    return FoliarSides(
        foliar_side(front, facing, transmittance, sun_light, sky, t, vec2(foliar_dot(front, a), foliar_dot(front, b)), optics),
        foliar_side(back, -facing, transmittance, sun_light, sky, t, vec2(foliar_dot(back, a), foliar_dot(back, b)), optics));
}

// Radiance that leaves both sides under an irradiance of both.
FoliarSides foliar_radiance(FoliarSides light, FoliarOptics optics) {
    return FoliarSides(
        (optics.r_front * light.front + optics.t_back * light.back) / FOLIAR_PI,
        (optics.r_back * light.back + optics.t_front * light.front) / FOLIAR_PI);
}
