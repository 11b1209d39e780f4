//! The program `foliar-noise`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_library("noise", foliar_programs::BAKERS)
}
