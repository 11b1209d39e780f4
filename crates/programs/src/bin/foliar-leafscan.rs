//! The program `foliar-leafscan`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_library("leafscan", foliar_programs::BAKERS)
}
