//! The program `foliar-view`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_view(foliar_programs::BAKERS)
}
