//! The program `foliar-pack`.

fn main() -> std::process::ExitCode {
    foliar_shell::foliar_pack(foliar_programs::BAKERS)
}
