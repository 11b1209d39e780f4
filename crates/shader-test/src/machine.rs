//! Statements and expressions of a function, one after the other.

use crate::value::fault;
use crate::{ShaderError, Value, math, operate};
use naga::{Arena, Block, Expression, Function, Handle, Literal, Module, Statement, SwitchValue};

type Outcome<T> = Result<T, ShaderError>;

/// Most statements of one call: an endless loop is an error.
const MOST_STEPS: usize = 10_000_000;

/// Calls a function from outside.
pub(crate) fn call(module: &Module, function: &Function, arguments: &[Value]) -> Outcome<Value> {
    let mut memory = Memory::default();
    run(module, function, arguments, &mut memory)
}

/// Variables of all functions that are being run.
#[derive(Default)]
struct Memory {
    slots: Vec<Value>,
    steps: usize,
}

/// How a block ends.
enum Flow {
    Next,
    Break,
    Continue,
    Return(Value),
}

fn run(module: &Module, function: &Function, arguments: &[Value], memory: &mut Memory) -> Outcome<Value> {
    if arguments.len() != function.arguments.len() {
        return Err(fault(format!("{} arguments, {} given", function.arguments.len(), arguments.len())));
    }
    let first = memory.slots.len();
    let mut frame =
        Frame { module, function, arguments, memory, first, values: vec![None; function.expressions.len()] };
    for (_, variable) in function.local_variables.iter() {
        let value = match variable.init {
            Some(init) => frame.value(init)?,
            None => Value::zero(module, variable.ty)?,
        };
        frame.memory.slots.push(value);
    }
    let flow = frame.block(&function.body)?;
    memory.slots.truncate(first);
    match flow {
        Flow::Return(value) => Ok(value),
        _ => Ok(Value::List(Vec::new())),
    }
}

/// A function that is being run.
struct Frame<'a> {
    module: &'a Module,
    function: &'a Function,
    arguments: &'a [Value],
    memory: &'a mut Memory,
    first: usize,
    /// What was emitted so far.
    values: Vec<Option<Value>>,
}

impl Frame<'_> {
    fn block(&mut self, block: &Block) -> Outcome<Flow> {
        for statement in block.iter() {
            self.memory.steps += 1;
            if self.memory.steps > MOST_STEPS {
                return Err(fault(format!("no end after {MOST_STEPS} steps")));
            }
            match self.statement(statement)? {
                Flow::Next => {}
                flow => return Ok(flow),
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, statement: &Statement) -> Outcome<Flow> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.compute(handle)?;
                    self.values[handle.index()] = Some(value);
                }
            }
            Statement::Block(block) => return self.block(block),
            Statement::If { condition, accept, reject } => {
                let holds = self.value(*condition)?.bool()?;
                return self.block(if holds { accept } else { reject });
            }
            Statement::Switch { selector, cases } => return self.switch(*selector, cases),
            Statement::Loop { body, continuing, break_if } => return self.repeat(body, continuing, *break_if),
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                let value = value.map(|v| self.value(v)).transpose()?;
                return Ok(Flow::Return(value.unwrap_or(Value::List(Vec::new()))));
            }
            Statement::Store { pointer, value } => {
                let (pointer, value) = (self.value(*pointer)?, self.value(*value)?);
                let Value::Pointer { slot, path } = pointer else { return Err(fault("a store to no variable")) };
                self.memory.slots[slot].set(&path, value)?;
            }
            Statement::Call { function, arguments, result } => {
                let arguments = arguments.iter().map(|a| self.value(*a)).collect::<Outcome<Vec<_>>>()?;
                let value = run(self.module, &self.module.functions[*function], &arguments, self.memory)?;
                if let Some(result) = result {
                    self.values[result.index()] = Some(value);
                }
            }
            other => return Err(fault(format!("statement {other:?}"))),
        }
        Ok(Flow::Next)
    }

    fn switch(&mut self, selector: Handle<Expression>, cases: &[naga::SwitchCase]) -> Outcome<Flow> {
        let selected = self.value(selector)?;
        let hits = |value: &SwitchValue| match value {
            SwitchValue::I32(v) => selected == Value::Int(*v),
            SwitchValue::U32(v) => selected == Value::Uint(*v),
            SwitchValue::Default => false,
        };
        let default = || cases.iter().position(|case| matches!(case.value, SwitchValue::Default));
        let Some(start) = cases.iter().position(|case| hits(&case.value)).or_else(default) else {
            return Ok(Flow::Next);
        };
        for case in &cases[start..] {
            match self.block(&case.body)? {
                Flow::Next if case.fall_through => {}
                Flow::Next | Flow::Break => return Ok(Flow::Next),
                flow => return Ok(flow),
            }
        }
        Ok(Flow::Next)
    }

    fn repeat(&mut self, body: &Block, continuing: &Block, until: Option<Handle<Expression>>) -> Outcome<Flow> {
        loop {
            match self.block(body)? {
                Flow::Next | Flow::Continue => {}
                Flow::Break => return Ok(Flow::Next),
                flow => return Ok(flow),
            }
            self.block(continuing)?;
            if let Some(until) = until
                && self.value(until)?.bool()?
            {
                return Ok(Flow::Next);
            }
        }
    }

    /// What an expression is: as emitted, or on demand for what needs no emitting.
    fn value(&mut self, handle: Handle<Expression>) -> Outcome<Value> {
        match &self.values[handle.index()] {
            Some(value) => Ok(value.clone()),
            None => self.compute(handle),
        }
    }

    fn compute(&mut self, handle: Handle<Expression>) -> Outcome<Value> {
        let function = self.function;
        match &function.expressions[handle] {
            Expression::FunctionArgument(index) => Ok(self.arguments[*index as usize].clone()),
            Expression::LocalVariable(variable) => {
                Ok(Value::Pointer { slot: self.first + variable.index(), path: Vec::new() })
            }
            Expression::Load { pointer } => match self.value(*pointer)? {
                Value::Pointer { slot, path } => self.memory.slots[slot].at(&path).cloned(),
                other => Err(fault(format!("a load from {other:?}"))),
            },
            Expression::CallResult(_) => {
                self.values[handle.index()].clone().ok_or_else(|| fault("a result before its call"))
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let handles = [Some(*arg), *arg1, *arg2, *arg3];
                let arguments = handles.into_iter().flatten().map(|a| self.value(a)).collect::<Outcome<Vec<_>>>()?;
                math::apply(*fun, &arguments)
            }
            other => pure(self.module, other, &mut |handle| self.value(handle)),
        }
    }
}

/// A constant of the module.
fn constant(module: &Module, arena: &Arena<Expression>, handle: Handle<Expression>) -> Outcome<Value> {
    pure(module, &arena[handle], &mut |inner| constant(module, arena, inner))
}

/// Expressions that depend on nothing but their operands.
fn pure(
    module: &Module,
    expression: &Expression,
    value: &mut dyn FnMut(Handle<Expression>) -> Outcome<Value>,
) -> Outcome<Value> {
    match expression {
        Expression::Literal(literal) => self::literal(literal),
        Expression::Constant(handle) => constant(module, &module.global_expressions, module.constants[*handle].init),
        Expression::ZeroValue(ty) => Value::zero(module, *ty),
        Expression::Compose { ty, components } => {
            let parts = components.iter().map(|c| value(*c)).collect::<Outcome<Vec<_>>>()?;
            Ok(operate::compose(&module.types[*ty].inner, parts))
        }
        Expression::Access { base, index } => {
            let (base, index) = (value(*base)?, value(*index)?.index()?);
            operate::access(base, index)
        }
        Expression::AccessIndex { base, index } => operate::access(value(*base)?, *index as usize),
        Expression::Splat { size, value: of } => Ok(Value::List(vec![value(*of)?; *size as usize])),
        Expression::Swizzle { size, vector, pattern } => {
            let vector = value(*vector)?;
            let picked = pattern[..*size as usize].iter().map(|c| vector.member(*c as usize).cloned());
            Ok(Value::List(picked.collect::<Outcome<_>>()?))
        }
        Expression::Unary { op, expr } => operate::unary(*op, &value(*expr)?),
        Expression::Binary { op, left, right } => operate::binary(*op, &value(*left)?, &value(*right)?),
        Expression::Select { condition, accept, reject } => {
            operate::select(&value(*condition)?, &value(*accept)?, &value(*reject)?)
        }
        Expression::Relational { fun, argument } => operate::relational(*fun, &value(*argument)?),
        Expression::As { expr, kind, convert } => operate::convert(&value(*expr)?, *kind, convert.is_some()),
        other => Err(fault(format!("expression {other:?}"))),
    }
}

fn literal(literal: &Literal) -> Outcome<Value> {
    match *literal {
        Literal::F32(value) => Ok(Value::Float(value)),
        Literal::I32(value) => Ok(Value::Int(value)),
        Literal::U32(value) => Ok(Value::Uint(value)),
        Literal::Bool(value) => Ok(Value::Bool(value)),
        other => Err(fault(format!("literal {other:?}"))),
    }
}
