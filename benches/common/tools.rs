//! The tools themselves, as a shell runs them.

use std::process::Command;

/// A shell script that finds the tools first.
pub fn shell(script: &str) -> Command {
    let tools = std::path::Path::new(env!("CARGO_BIN_EXE_vkernel")).parent().unwrap();
    let others = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new("sh");
    command.args(["-euc", script]).env("PATH", format!("{}:{others}", tools.display()));
    command
}
