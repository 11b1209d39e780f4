//! The program `foliar-translucency`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_room("translucency", foliar_programs::BAKERS)
}
