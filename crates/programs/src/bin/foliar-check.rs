//! The program `foliar-check`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_check(foliar_programs::BAKERS)
}
