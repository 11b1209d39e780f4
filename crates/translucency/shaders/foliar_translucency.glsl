// Light through leaves of FOLIAR_foliage, to be included in a fragment shader (docs/translucency-runtime.md explains each step).
// No bindings: texels, scale, bias and curve are read by whoever includes this. Tests run it against the f64 evaluator.

// Light in the frame of a map. `light` points toward the light, `tangent` and `bitangent` along the image (right, up) on
// either side of the leaf, `seen_normal` out of the side that shows the map (turn it over where gl_FrontFacing is false).
vec3 foliar_lit_direction(vec3 light, vec3 tangent, vec3 bitangent, vec3 seen_normal) {
    return vec3(dot(light, tangent), dot(light, bitangent), -dot(light, seen_normal));
}

// Coefficients of a texel of diffuseTransmissionTexture.
vec3 foliar_translucency_decoded(vec3 texel, vec3 scale, vec3 bias) {
    return texel * scale + bias;
}

// The three dot products, once per light; zero for light on the side that is seen.
vec3 foliar_translucency_weights(vec3 light) {
    if (light.z <= 0.0) {
        return vec3(0.0);
    }
    float axis = 0.57735026919 * light.z;
    float side = 0.70710678118 * light.y;
    float back = axis - 0.40824829046 * light.x;
    return vec3(0.81649658093 * light.x + axis, back + side, back - side);
}

// Share of the light that comes through. `curve` is (a0, a1) of the extension, (1, 0) where it names none. Radiance of the
// leaf is this times irradiance / pi, times the color of diffuse transmission, times shadow.
float foliar_transmitted(vec3 coefficients, vec3 light, vec2 curve) {
    float bend = max(0.0, curve.x + curve.y * light.z);
    return max(0.0, dot(coefficients, foliar_translucency_weights(light))) * bend;
}

// The same for a map of each band.
vec3 foliar_transmitted_rgb(vec3 red, vec3 green, vec3 blue, vec3 light, vec2 curves[3]) {
    return vec3(
        foliar_transmitted(red, light, curves[0]),
        foliar_transmitted(green, light, curves[1]),
        foliar_transmitted(blue, light, curves[2])
    );
}

// Share of even light from the whole hemisphere behind the leaf, over its irradiance.
float foliar_transmitted_diffuse(vec3 coefficients, vec2 curve) {
    float axis = 0.57735026919 * (coefficients.x + coefficients.y + coefficients.z);
    return max(0.0, axis * (curve.x + curve.y * 0.66666666667));
}
