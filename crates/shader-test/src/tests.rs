//! The machine against closed forms, in both languages.

use crate::{Shader, ShaderError, Value};

const WGSL: &str = r"
struct Pair { low: f32, list: array<vec3<f32>, 2> }
const SCALE: f32 = 2.0;
fn poly(x: f32) -> f32 { var sum = 0.0; for (var i = 0; i < 4; i++) { if (i == 2) { continue; } sum += pow(x, f32(i)); } return sum; }
fn turn(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> { let t = SCALE * cross(q.xyz, v); return v + q.w * t + cross(q.xyz, t); }
fn pair(v: vec3<f32>) -> Pair { var p: Pair; p.low = min(v.x, v.y); p.list[1] = normalize(v); p.list[0] = mat3x3<f32>(v, v, v) * vec3<f32>(1.0, 0.0, 2.0); return p; }
fn pick(i: i32) -> u32 { switch i { case 1: { return 10u; } case 2, 3: { return 20u; } default: { return u32(i) << 2u; } } }
fn add(p: ptr<function, f32>) { *p += 1.0; }
fn pointer() -> f32 { var x = 1.5; add(&x); add(&x); return x; }
fn endless() -> f32 { var x = 0.0; loop { x += 1.0; } return x; }
";

const GLSL: &str = r"
struct Pair { float low; vec3 list[2]; };
const float SCALE = 2.0;
float poly(float x) { float sum = 0.0; for (int i = 0; i < 4; i++) { if (i == 2) continue; sum += pow(x, float(i)); } return sum; }
vec3 turn(vec4 q, vec3 v) { vec3 t = SCALE * cross(q.xyz, v); return v + q.w * t + cross(q.xyz, t); }
Pair pair(vec3 v) { Pair p; p.low = min(v.x, v.y); p.list[1] = normalize(v); p.list[0] = mat3(v, v, v) * vec3(1.0, 0.0, 2.0); return p; }
void add(inout float p) { p += 1.0; }
float pointer() { float x = 1.5; add(x); add(x); return x; }
";

fn both() -> [Shader; 2] {
    [Shader::wgsl(WGSL).unwrap(), Shader::glsl(GLSL).unwrap()]
}

#[test]
fn functions_give_what_they_say() {
    for shader in both() {
        let call = |name: &str, arguments: &[Value]| shader.call(name, arguments).unwrap().floats().unwrap();
        // Sums and products of small whole numbers are exact.
        assert_eq!(call("poly", &[3.0f32.into()]), [31.0]);
        assert_eq!(call("turn", &[[0.0f32, 0.0, 1.0, 0.0].into(), [1.0f32, 2.0, 3.0].into()]), [-1.0, -2.0, 3.0]);
        assert_eq!(call("pair", &[[3.0f32, 0.0, 4.0].into()]), [0.0, 9.0, 0.0, 12.0, 0.6, 0.0, 0.8]);
        assert_eq!(call("pointer", &[]), [3.5]);
    }
}

#[test]
fn switches_pick_their_case() {
    let [shader, _] = both();
    for (given, expected) in [(1, 10u32), (2, 20), (3, 20), (5, 20), (7, 28)] {
        assert_eq!(shader.call("pick", &[given.into()]).unwrap(), Value::Uint(expected), "{given}");
    }
}

#[test]
fn what_cannot_be_run_is_said() {
    let [shader, _] = both();
    assert!(matches!(shader.call("none", &[]), Err(ShaderError::Missing(..))));
    assert!(matches!(shader.call("poly", &[]), Err(ShaderError::Run(_))));
    assert!(matches!(shader.call("endless", &[]), Err(ShaderError::Run(_))));
    assert!(matches!(Shader::wgsl("fn f( {"), Err(ShaderError::Parse(_))));
    assert!(matches!(
        Shader::wgsl("fn f() -> f32 { return 1u; }"),
        Err(ShaderError::Parse(_) | ShaderError::Invalid(_))
    ));
    assert!(matches!(Shader::glsl("float f() { return x; }"), Err(ShaderError::Parse(_))));
}
