//! Values of a shader: scalars, and lists of them for vectors, matrices (by columns), arrays and structs.

use crate::ShaderError;
use naga::{ArraySize, Handle, Module, Scalar, ScalarKind, Type, TypeInner};

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `f32`.
    Float(f32),
    /// `i32`.
    Int(i32),
    /// `u32`.
    Uint(u32),
    /// `bool`.
    Bool(bool),
    /// Vector, matrix (columns), array or struct (members in order).
    List(Vec<Value>),
    /// Where a variable lies in the machine's memory; never seen from outside.
    Pointer {
        /// Which variable.
        slot: usize,
        /// Members on the way down.
        path: Vec<usize>,
    },
}

pub(crate) fn fault(what: impl Into<String>) -> ShaderError {
    ShaderError::Run(what.into())
}

impl From<f32> for Value {
    fn from(value: f32) -> Value {
        Value::Float(value)
    }
}

impl From<i32> for Value {
    fn from(value: i32) -> Value {
        Value::Int(value)
    }
}

impl From<u32> for Value {
    fn from(value: u32) -> Value {
        Value::Uint(value)
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Value {
        Value::Bool(value)
    }
}

/// A vector, matrix or array.
impl<T: Into<Value>, const N: usize> From<[T; N]> for Value {
    fn from(values: [T; N]) -> Value {
        Value::List(values.into_iter().map(Into::into).collect())
    }
}

impl Value {
    /// A struct or array of these members.
    pub fn list(members: impl IntoIterator<Item = Value>) -> Value {
        Value::List(members.into_iter().collect())
    }

    /// All its floats, depth first.
    ///
    /// # Errors
    /// Where something in it is no float.
    pub fn floats(&self) -> Result<Vec<f32>, ShaderError> {
        match self {
            Value::Float(value) => Ok(vec![*value]),
            Value::List(members) => {
                members.iter().map(Value::floats).collect::<Result<Vec<_>, _>>().map(|l| l.concat())
            }
            other => Err(fault(format!("{other:?} is no float"))),
        }
    }

    /// A member of a vector, array or struct.
    ///
    /// # Errors
    /// Where there is none of this index.
    pub fn member(&self, index: usize) -> Result<&Value, ShaderError> {
        self.members()?.get(index).ok_or_else(|| fault(format!("no member {index} of {self:?}")))
    }

    pub(crate) fn members(&self) -> Result<&[Value], ShaderError> {
        match self {
            Value::List(members) => Ok(members),
            other => Err(fault(format!("{other:?} has no members"))),
        }
    }

    pub(crate) fn float(&self) -> Result<f32, ShaderError> {
        match self {
            Value::Float(value) => Ok(*value),
            other => Err(fault(format!("{other:?} is no float"))),
        }
    }

    pub(crate) fn bool(&self) -> Result<bool, ShaderError> {
        match self {
            Value::Bool(value) => Ok(*value),
            other => Err(fault(format!("{other:?} is no bool"))),
        }
    }

    pub(crate) fn index(&self) -> Result<usize, ShaderError> {
        match self {
            Value::Int(value) if *value >= 0 => Ok(*value as usize),
            Value::Uint(value) => Ok(*value as usize),
            other => Err(fault(format!("{other:?} is no index"))),
        }
    }

    /// How deep lists lie in it: 0 for a scalar, 1 for a vector, 2 for a matrix.
    pub(crate) fn depth(&self) -> usize {
        match self {
            Value::List(members) => 1 + members.first().map_or(0, Value::depth),
            _ => 0,
        }
    }

    /// The member at the end of a path.
    pub(crate) fn at(&self, path: &[usize]) -> Result<&Value, ShaderError> {
        path.iter().try_fold(self, |value, index| value.member(*index))
    }

    /// Writes the member at the end of a path.
    pub(crate) fn set(&mut self, path: &[usize], new: Value) -> Result<(), ShaderError> {
        let Some((first, rest)) = path.split_first() else {
            *self = new;
            return Ok(());
        };
        match self {
            Value::List(members) if *first < members.len() => members[*first].set(rest, new),
            other => Err(fault(format!("no member {first} of {other:?}"))),
        }
    }

    /// Zero of a type.
    pub(crate) fn zero(module: &Module, ty: Handle<Type>) -> Result<Value, ShaderError> {
        let times = |count: usize, value: Value| Value::List(vec![value; count]);
        Ok(match &module.types[ty].inner {
            TypeInner::Scalar(scalar) => zero_scalar(*scalar)?,
            TypeInner::Vector { size, scalar } => times(*size as usize, zero_scalar(*scalar)?),
            TypeInner::Matrix { columns, rows, scalar } => {
                times(*columns as usize, times(*rows as usize, zero_scalar(*scalar)?))
            }
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                times(count.get() as usize, Value::zero(module, *base)?)
            }
            TypeInner::Struct { members, .. } => {
                Value::List(members.iter().map(|m| Value::zero(module, m.ty)).collect::<Result<_, _>>()?)
            }
            other => return Err(fault(format!("no values of type {other:?}"))),
        })
    }
}

fn zero_scalar(scalar: Scalar) -> Result<Value, ShaderError> {
    match scalar.kind {
        ScalarKind::Float => Ok(Value::Float(0.0)),
        ScalarKind::Sint => Ok(Value::Int(0)),
        ScalarKind::Uint => Ok(Value::Uint(0)),
        ScalarKind::Bool => Ok(Value::Bool(false)),
        other => Err(fault(format!("no values of kind {other:?}"))),
    }
}
