//! The program `foliar-import`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_import(foliar_programs::BAKERS)
}
