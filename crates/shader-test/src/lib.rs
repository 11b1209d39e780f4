//! Runs single functions of a WGSL or GLSL include on the processor, in f32, so that a test compares what is shipped with
//! Rust. Source is parsed and validated by `naga`; this crate walks the IR that comes out.
//!
//! Functions over scalars, vectors, matrices, arrays and structs, with locals, branches, loops and calls. No
//! textures, buffers, derivatives or atomics: includes take what they need as arguments.

mod machine;
mod math;
mod operate;
mod value;

pub use value::Value;

use naga::front::{glsl, wgsl};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

/// Why a shader cannot be read or run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShaderError {
    /// It does not parse.
    #[error("{0}")]
    Parse(String),
    /// It parses and is not valid.
    #[error("not valid: {0}")]
    Invalid(String),
    /// No function of this name.
    #[error("no function {0}; there are {1}")]
    Missing(String, String),
    /// Something that this machine does not know, or arguments that do not fit.
    #[error("cannot run: {0}")]
    Run(String),
}

/// A shader that was parsed and found valid.
#[derive(Debug)]
pub struct Shader {
    module: Module,
}

impl Shader {
    /// Reads WGSL.
    ///
    /// # Errors
    /// [`ShaderError::Parse`] and [`ShaderError::Invalid`], with the place in the source.
    pub fn wgsl(source: &str) -> Result<Shader, ShaderError> {
        let module = wgsl::parse_str(source).map_err(|error| ShaderError::Parse(error.emit_to_string(source)))?;
        Shader::checked(module, source)
    }

    /// Reads the functions of a GLSL include; an empty `main` is put behind them.
    ///
    /// # Errors
    /// As [`Shader::wgsl`].
    pub fn glsl(include: &str) -> Result<Shader, ShaderError> {
        let source = format!("#version 450\n{include}\nvoid main() {{}}\n");
        let module = glsl::Frontend::default()
            .parse(&glsl::Options::from(ShaderStage::Fragment), &source)
            .map_err(|error| ShaderError::Parse(error.emit_to_string(&source)))?;
        Shader::checked(module, &source)
    }

    fn checked(module: Module, source: &str) -> Result<Shader, ShaderError> {
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        validator.validate(&module).map_err(|error| ShaderError::Invalid(error.emit_to_string(source)))?;
        Ok(Shader { module })
    }

    /// Names of its functions.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        self.module.functions.iter().filter_map(|(_, function)| function.name.as_deref())
    }

    /// Calls a function. Pointers (`out`, `inout`) cannot be passed from outside: return a struct.
    ///
    /// # Errors
    /// [`ShaderError::Missing`] for a name that it does not have, [`ShaderError::Run`] for what cannot be run.
    pub fn call(&self, name: &str, arguments: &[Value]) -> Result<Value, ShaderError> {
        let found = self.module.functions.iter().find(|(_, function)| function.name.as_deref() == Some(name));
        let Some((_, function)) = found else {
            let names: Vec<&str> = self.functions().collect();
            return Err(ShaderError::Missing(name.into(), names.join(", ")));
        };
        machine::call(&self.module, function, arguments)
    }
}

#[cfg(test)]
mod tests;
