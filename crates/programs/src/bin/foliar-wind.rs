//! The program `foliar-wind`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_room("wind", foliar_programs::BAKERS)
}
