//! The program `foliar-density`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_room("density", foliar_programs::BAKERS)
}
