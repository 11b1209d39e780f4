// Light through leaves of FOLIAR_foliage, to be put in front of a fragment shader (docs/translucency-runtime.md explains each step).
// No bindings: texels, scale, bias and curve are read by whoever includes this. Tests run it against the f64 evaluator.

// Light in the frame of a map. `light` points toward the light, `tangent` and `bitangent` along the image (right, up) on
// either side of the leaf, `seen_normal` out of the side that shows the map (turn it over where front_facing is false).
fn foliar_lit_direction(
    light: vec3<f32>, tangent: vec3<f32>, bitangent: vec3<f32>, seen_normal: vec3<f32>,
) -> vec3<f32> {
    return vec3<f32>(dot(light, tangent), dot(light, bitangent), -dot(light, seen_normal));
}

// Coefficients of a texel of diffuseTransmissionTexture.
fn foliar_translucency_decoded(texel: vec3<f32>, scale: vec3<f32>, bias: vec3<f32>) -> vec3<f32> {
    return texel * scale + bias;
}

// The three dot products, once per light; zero for light on the side that is seen.
fn foliar_translucency_weights(light: vec3<f32>) -> vec3<f32> {
    if (light.z <= 0.0) {
        return vec3<f32>(0.0);
    }
    let axis = 0.57735026919 * light.z;
    let side = 0.70710678118 * light.y;
    let back = axis - 0.40824829046 * light.x;
    return vec3<f32>(0.81649658093 * light.x + axis, back + side, back - side);
}

// Share of the light that comes through. `curve` is (a0, a1) of the extension, (1, 0) where it names none. Radiance of the
// leaf is this times irradiance / pi, times the color of diffuse transmission, times shadow.
fn foliar_transmitted(coefficients: vec3<f32>, light: vec3<f32>, curve: vec2<f32>) -> f32 {
    let bend = max(0.0, curve.x + curve.y * light.z);
    return max(0.0, dot(coefficients, foliar_translucency_weights(light))) * bend;
}

// The same for a map of each band.
fn foliar_transmitted_rgb(
    red: vec3<f32>, green: vec3<f32>, blue: vec3<f32>, light: vec3<f32>, curves: array<vec2<f32>, 3>,
) -> vec3<f32> {
    return vec3<f32>(
        foliar_transmitted(red, light, curves[0]),
        foliar_transmitted(green, light, curves[1]),
        foliar_transmitted(blue, light, curves[2]),
    );
}

// Share of even light from the whole hemisphere behind the leaf, over its irradiance.
fn foliar_transmitted_diffuse(coefficients: vec3<f32>, curve: vec2<f32>) -> f32 {
    let axis = 0.57735026919 * (coefficients.x + coefficients.y + coefficients.z);
    return max(0.0, axis * (curve.x + curve.y * 0.66666666667));
}
