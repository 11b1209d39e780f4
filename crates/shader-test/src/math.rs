//! Built-in functions. Transcendental ones come from crate `libm`; a graphics card's differ in the last bits.

use crate::operate::{dot, map, zip};
use crate::value::fault;
use crate::{ShaderError, Value};
use naga::MathFunction as F;

type Outcome<T> = Result<T, ShaderError>;

/// Applies a built-in function.
pub(crate) fn apply(fun: F, arguments: &[Value]) -> Outcome<Value> {
    if let Some(function) = of_one(fun) {
        return map(argument(arguments, 0)?, &|v| Ok(Value::Float(function(v.float()?))));
    }
    match fun {
        F::Abs | F::Sign => map(argument(arguments, 0)?, &|v| magnitude(fun, v)),
        F::Min | F::Max => zip(argument(arguments, 0)?, argument(arguments, 1)?, &|a, b| extreme(fun, a, b)),
        F::Clamp => {
            let floor = zip(argument(arguments, 0)?, argument(arguments, 1)?, &|a, b| extreme(F::Max, a, b))?;
            zip(&floor, argument(arguments, 2)?, &|a, b| extreme(F::Min, a, b))
        }
        F::Pow => of_two(arguments, libm::powf),
        F::Atan2 => of_two(arguments, libm::atan2f),
        F::Step => of_two(arguments, |edge, x| if x < edge { 0.0 } else { 1.0 }),
        F::Mix => of_three(arguments, |a, b, t| a * (1.0 - t) + b * t),
        F::Fma => of_three(arguments, |a, b, c| a * b + c),
        F::SmoothStep => of_three(arguments, |low, high, x| {
            let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        }),
        F::Dot => dot(argument(arguments, 0)?, argument(arguments, 1)?),
        F::Cross => cross(argument(arguments, 0)?, argument(arguments, 1)?),
        F::Length => length(argument(arguments, 0)?).map(Value::Float),
        F::Distance => length(&subtract(argument(arguments, 0)?, argument(arguments, 1)?)?).map(Value::Float),
        F::Normalize => {
            let vector = argument(arguments, 0)?;
            scaled(vector, 1.0 / length(vector)?)
        }
        F::Reflect => {
            let (way, normal) = (argument(arguments, 0)?, argument(arguments, 1)?);
            subtract(way, &scaled(normal, 2.0 * dot(normal, way)?.float()?)?)
        }
        F::Transpose => transpose(argument(arguments, 0)?),
        other => Err(fault(format!("built-in {other:?}"))),
    }
}

fn argument(arguments: &[Value], index: usize) -> Outcome<&Value> {
    arguments.get(index).ok_or_else(|| fault(format!("no argument {index}")))
}

/// Built-ins that take one float.
fn of_one(fun: F) -> Option<fn(f32) -> f32> {
    Some(match fun {
        F::Saturate => |x| x.clamp(0.0, 1.0),
        F::Cos => libm::cosf,
        F::Cosh => libm::coshf,
        F::Sin => libm::sinf,
        F::Sinh => libm::sinhf,
        F::Tan => libm::tanf,
        F::Tanh => libm::tanhf,
        F::Acos => libm::acosf,
        F::Asin => libm::asinf,
        F::Atan => libm::atanf,
        F::Asinh => libm::asinhf,
        F::Acosh => libm::acoshf,
        F::Atanh => libm::atanhf,
        F::Radians => f32::to_radians,
        F::Degrees => f32::to_degrees,
        F::Ceil => f32::ceil,
        F::Floor => f32::floor,
        F::Round => f32::round_ties_even,
        F::Fract => |x| x - x.floor(),
        F::Trunc => f32::trunc,
        F::Exp => libm::expf,
        F::Exp2 => libm::exp2f,
        F::Log => libm::logf,
        F::Log2 => libm::log2f,
        F::Sqrt => f32::sqrt,
        F::InverseSqrt => |x| 1.0 / x.sqrt(),
        _ => return None,
    })
}

fn of_two(arguments: &[Value], function: fn(f32, f32) -> f32) -> Outcome<Value> {
    let of = |a: &Value, b: &Value| Ok(Value::Float(function(a.float()?, b.float()?)));
    zip(argument(arguments, 0)?, argument(arguments, 1)?, &of)
}

/// The third argument may be a scalar where the others are vectors; so may the first two for `smoothstep`.
fn of_three(arguments: &[Value], function: fn(f32, f32, f32) -> f32) -> Outcome<Value> {
    let values = [argument(arguments, 0)?, argument(arguments, 1)?, argument(arguments, 2)?];
    let count = values.iter().find_map(|v| v.members().ok().map(<[Value]>::len));
    let at = |value: &Value, index: usize| match value {
        Value::List(_) => value.member(index)?.float(),
        scalar => scalar.float(),
    };
    let one =
        |index: usize| Ok(Value::Float(function(at(values[0], index)?, at(values[1], index)?, at(values[2], index)?)));
    match count {
        Some(count) => Ok(Value::List((0..count).map(one).collect::<Outcome<_>>()?)),
        None => one(0),
    }
}

fn magnitude(fun: F, value: &Value) -> Outcome<Value> {
    let absolute = fun == F::Abs;
    Ok(match value {
        Value::Float(v) if absolute => Value::Float(v.abs()),
        Value::Float(v) if *v > 0.0 => Value::Float(1.0),
        Value::Float(v) if *v < 0.0 => Value::Float(-1.0),
        Value::Float(_) => Value::Float(0.0),
        Value::Int(v) => Value::Int(if absolute { v.wrapping_abs() } else { v.signum() }),
        Value::Uint(v) if absolute => Value::Uint(*v),
        other => return Err(fault(format!("{fun:?} of {other:?}"))),
    })
}

fn extreme(fun: F, a: &Value, b: &Value) -> Outcome<Value> {
    let least = fun == F::Min;
    Ok(match (a, b) {
        (Value::Float(a), Value::Float(b)) => Value::Float(if least { a.min(*b) } else { a.max(*b) }),
        (Value::Int(a), Value::Int(b)) => Value::Int(if least { *a.min(b) } else { *a.max(b) }),
        (Value::Uint(a), Value::Uint(b)) => Value::Uint(if least { *a.min(b) } else { *a.max(b) }),
        _ => return Err(fault(format!("{fun:?} of {a:?} and {b:?}"))),
    })
}

fn subtract(a: &Value, b: &Value) -> Outcome<Value> {
    zip(a, b, &|a, b| Ok(Value::Float(a.float()? - b.float()?)))
}

fn scaled(vector: &Value, factor: f32) -> Outcome<Value> {
    map(vector, &|v| Ok(Value::Float(v.float()? * factor)))
}

fn length(value: &Value) -> Outcome<f32> {
    match value {
        Value::List(_) => Ok(dot(value, value)?.float()?.sqrt()),
        scalar => Ok(scalar.float()?.abs()),
    }
}

fn cross(a: &Value, b: &Value) -> Outcome<Value> {
    let (a, b) = (a.floats()?, b.floats()?);
    let ([ax, ay, az], [bx, by, bz]) = (&a[..], &b[..]) else { return Err(fault("a cross product needs vec3")) };
    Ok([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx].into())
}

fn transpose(matrix: &Value) -> Outcome<Value> {
    let columns = matrix.members()?;
    let rows = columns.first().map_or(0, |column| column.members().map_or(0, <[Value]>::len));
    let row = |r: usize| Ok(Value::List(columns.iter().map(|c| c.member(r).cloned()).collect::<Outcome<_>>()?));
    Ok(Value::List((0..rows).map(row).collect::<Outcome<_>>()?))
}
