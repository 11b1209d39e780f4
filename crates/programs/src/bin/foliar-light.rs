//! The program `foliar-light`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_room("light", foliar_programs::BAKERS)
}
