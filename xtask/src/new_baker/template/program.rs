//! The program `foliar-__room__`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_room("__room__", foliar_programs::BAKERS)
}
