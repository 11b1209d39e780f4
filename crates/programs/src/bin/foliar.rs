//! The program `foliar`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar(foliar_programs::BAKERS)
}
