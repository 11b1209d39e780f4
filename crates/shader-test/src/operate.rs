//! Operators and conversions.

use crate::value::fault;
use crate::{ShaderError, Value};
use naga::{BinaryOperator, RelationalFunction, ScalarKind, TypeInner, UnaryOperator};

type Outcome<T> = Result<T, ShaderError>;

/// A vector from scalars and shorter vectors; everything else from its members.
pub(crate) fn compose(ty: &TypeInner, parts: Vec<Value>) -> Value {
    let flat = |part: Value| match part {
        Value::List(members) => members,
        scalar => vec![scalar],
    };
    match ty {
        TypeInner::Vector { .. } => Value::List(parts.into_iter().flat_map(flat).collect()),
        _ => Value::List(parts),
    }
}

/// A member, or the pointer to it.
pub(crate) fn access(base: Value, index: usize) -> Outcome<Value> {
    match base {
        Value::Pointer { slot, mut path } => {
            path.push(index);
            Ok(Value::Pointer { slot, path })
        }
        other => other.member(index).cloned(),
    }
}

/// A function of scalars over all members.
pub(crate) fn map(value: &Value, scalar: &dyn Fn(&Value) -> Outcome<Value>) -> Outcome<Value> {
    match value {
        Value::List(members) => Ok(Value::List(members.iter().map(|m| map(m, scalar)).collect::<Outcome<_>>()?)),
        other => scalar(other),
    }
}

/// A function of two scalars over all pairs of members; a scalar meets every member of the other.
pub(crate) fn zip(a: &Value, b: &Value, scalar: &dyn Fn(&Value, &Value) -> Outcome<Value>) -> Outcome<Value> {
    match (a, b) {
        (Value::List(x), Value::List(y)) if x.len() == y.len() => {
            Ok(Value::List(x.iter().zip(y).map(|(a, b)| zip(a, b, scalar)).collect::<Outcome<_>>()?))
        }
        (Value::List(_), Value::List(_)) => Err(fault(format!("{a:?} and {b:?} differ in length"))),
        (Value::List(_), b) => map(a, &|a| scalar(a, b)),
        (a, Value::List(_)) => map(b, &|b| scalar(a, b)),
        (a, b) => scalar(a, b),
    }
}

pub(crate) fn unary(op: UnaryOperator, value: &Value) -> Outcome<Value> {
    map(value, &|value| match (op, value) {
        (UnaryOperator::Negate, Value::Float(v)) => Ok(Value::Float(-v)),
        (UnaryOperator::Negate, Value::Int(v)) => Ok(Value::Int(v.wrapping_neg())),
        (UnaryOperator::LogicalNot, Value::Bool(v)) => Ok(Value::Bool(!v)),
        (UnaryOperator::BitwiseNot, Value::Int(v)) => Ok(Value::Int(!v)),
        (UnaryOperator::BitwiseNot, Value::Uint(v)) => Ok(Value::Uint(!v)),
        (op, value) => Err(fault(format!("{op:?} of {value:?}"))),
    })
}

pub(crate) fn binary(op: BinaryOperator, a: &Value, b: &Value) -> Outcome<Value> {
    if op == BinaryOperator::Multiply {
        match (a.depth(), b.depth()) {
            (2, 1) => return matrix_times_vector(a, b),
            (1, 2) => return Ok(Value::List(b.members()?.iter().map(|c| dot(a, c)).collect::<Outcome<_>>()?)),
            (2, 2) => {
                let columns = b.members()?.iter().map(|column| matrix_times_vector(a, column));
                return Ok(Value::List(columns.collect::<Outcome<_>>()?));
            }
            _ => {}
        }
    }
    zip(a, b, &|a, b| scalars(op, a, b))
}

fn matrix_times_vector(matrix: &Value, vector: &Value) -> Outcome<Value> {
    let terms = matrix.members()?.iter().zip(vector.members()?);
    let mut terms = terms.map(|(column, factor)| zip(column, factor, &|a, b| scalars(BinaryOperator::Multiply, a, b)));
    let first = terms.next().unwrap_or_else(|| Err(fault("an empty matrix")))?;
    terms.try_fold(first, |sum, term| zip(&sum, &term?, &|a, b| scalars(BinaryOperator::Add, a, b)))
}

/// Sum of products.
pub(crate) fn dot(a: &Value, b: &Value) -> Outcome<Value> {
    let products = zip(a, b, &|a, b| scalars(BinaryOperator::Multiply, a, b))?;
    let (first, rest) = products.members()?.split_first().ok_or_else(|| fault("a dot product of nothing"))?;
    rest.iter().try_fold(first.clone(), |sum, term| scalars(BinaryOperator::Add, &sum, term))
}

fn scalars(op: BinaryOperator, a: &Value, b: &Value) -> Outcome<Value> {
    let result = match (a, b) {
        (Value::Float(a), Value::Float(b)) => floats(op, *a, *b),
        (Value::Int(a), Value::Int(b)) => ints(op, *a, *b),
        (Value::Uint(a), Value::Uint(b)) => uints(op, *a, *b),
        // Shifts take an unsigned count.
        (Value::Int(a), Value::Uint(b)) => ints(op, *a, *b as i32),
        (Value::Bool(a), Value::Bool(b)) => bools(op, *a, *b),
        _ => None,
    };
    result.ok_or_else(|| fault(format!("{a:?} {op:?} {b:?}")))
}

fn compared<T: PartialOrd>(op: BinaryOperator, a: T, b: T) -> Option<Value> {
    Some(Value::Bool(match op {
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual => a != b,
        BinaryOperator::Less => a < b,
        BinaryOperator::LessEqual => a <= b,
        BinaryOperator::Greater => a > b,
        BinaryOperator::GreaterEqual => a >= b,
        _ => return None,
    }))
}

fn floats(op: BinaryOperator, a: f32, b: f32) -> Option<Value> {
    Some(Value::Float(match op {
        BinaryOperator::Add => a + b,
        BinaryOperator::Subtract => a - b,
        BinaryOperator::Multiply => a * b,
        BinaryOperator::Divide => a / b,
        BinaryOperator::Modulo => a % b,
        other => return compared(other, a, b),
    }))
}

fn ints(op: BinaryOperator, a: i32, b: i32) -> Option<Value> {
    Some(Value::Int(match op {
        BinaryOperator::Add => a.wrapping_add(b),
        BinaryOperator::Subtract => a.wrapping_sub(b),
        BinaryOperator::Multiply => a.wrapping_mul(b),
        BinaryOperator::Divide => a.checked_div(b)?,
        BinaryOperator::Modulo => a.checked_rem(b)?,
        BinaryOperator::And => a & b,
        BinaryOperator::InclusiveOr => a | b,
        BinaryOperator::ExclusiveOr => a ^ b,
        BinaryOperator::ShiftLeft => a.wrapping_shl(b as u32),
        BinaryOperator::ShiftRight => a.wrapping_shr(b as u32),
        other => return compared(other, a, b),
    }))
}

fn uints(op: BinaryOperator, a: u32, b: u32) -> Option<Value> {
    Some(Value::Uint(match op {
        BinaryOperator::Add => a.wrapping_add(b),
        BinaryOperator::Subtract => a.wrapping_sub(b),
        BinaryOperator::Multiply => a.wrapping_mul(b),
        BinaryOperator::Divide => a.checked_div(b)?,
        BinaryOperator::Modulo => a.checked_rem(b)?,
        BinaryOperator::And => a & b,
        BinaryOperator::InclusiveOr => a | b,
        BinaryOperator::ExclusiveOr => a ^ b,
        BinaryOperator::ShiftLeft => a.wrapping_shl(b),
        BinaryOperator::ShiftRight => a.wrapping_shr(b),
        other => return compared(other, a, b),
    }))
}

fn bools(op: BinaryOperator, a: bool, b: bool) -> Option<Value> {
    Some(Value::Bool(match op {
        BinaryOperator::LogicalAnd | BinaryOperator::And => a && b,
        BinaryOperator::LogicalOr | BinaryOperator::InclusiveOr => a || b,
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual | BinaryOperator::ExclusiveOr => a != b,
        _ => return None,
    }))
}

pub(crate) fn select(condition: &Value, accept: &Value, reject: &Value) -> Outcome<Value> {
    match condition {
        Value::Bool(holds) => Ok(if *holds { accept.clone() } else { reject.clone() }),
        Value::List(list) => {
            let picked = list.iter().enumerate().map(|(i, c)| select(c, accept.member(i)?, reject.member(i)?));
            Ok(Value::List(picked.collect::<Outcome<_>>()?))
        }
        other => Err(fault(format!("{other:?} selects nothing"))),
    }
}

pub(crate) fn relational(fun: RelationalFunction, value: &Value) -> Outcome<Value> {
    match fun {
        RelationalFunction::All | RelationalFunction::Any => {
            let list: Vec<bool> = match value {
                Value::List(members) => members.iter().map(Value::bool).collect::<Outcome<_>>()?,
                scalar => vec![scalar.bool()?],
            };
            let all = fun == RelationalFunction::All;
            Ok(Value::Bool(if all { list.iter().all(|b| *b) } else { list.iter().any(|b| *b) }))
        }
        RelationalFunction::IsNan => map(value, &|v| Ok(Value::Bool(v.float()?.is_nan()))),
        RelationalFunction::IsInf => map(value, &|v| Ok(Value::Bool(v.float()?.is_infinite()))),
    }
}

/// To another kind of number, or the same bits taken for another.
pub(crate) fn convert(value: &Value, kind: ScalarKind, numeric: bool) -> Outcome<Value> {
    map(value, &|value| if numeric { number(value, kind) } else { bits(value, kind) })
}

fn number(value: &Value, kind: ScalarKind) -> Outcome<Value> {
    // An f64 holds each of them exactly.
    let exact = match value {
        Value::Float(v) => f64::from(*v),
        Value::Int(v) => f64::from(*v),
        Value::Uint(v) => f64::from(*v),
        Value::Bool(v) => f64::from(u8::from(*v)),
        other => return Err(fault(format!("{other:?} is no number"))),
    };
    Ok(match (kind, value) {
        (ScalarKind::Float, _) => Value::Float(exact as f32),
        (ScalarKind::Sint, Value::Uint(v)) => Value::Int(*v as i32),
        (ScalarKind::Sint, _) => Value::Int(exact as i32),
        (ScalarKind::Uint, Value::Int(v)) => Value::Uint(*v as u32),
        (ScalarKind::Uint, _) => Value::Uint(exact as u32),
        (ScalarKind::Bool, _) => Value::Bool(exact.abs() > 0.0),
        (other, _) => return Err(fault(format!("no values of kind {other:?}"))),
    })
}

fn bits(value: &Value, kind: ScalarKind) -> Outcome<Value> {
    let bits = match value {
        Value::Float(v) => v.to_bits(),
        Value::Int(v) => *v as u32,
        Value::Uint(v) => *v,
        other => return Err(fault(format!("{other:?} has no bits"))),
    };
    Ok(match kind {
        ScalarKind::Float => Value::Float(f32::from_bits(bits)),
        ScalarKind::Sint => Value::Int(bits as i32),
        ScalarKind::Uint => Value::Uint(bits),
        other => return Err(fault(format!("no bits of kind {other:?}"))),
    })
}
