//! The program in a shell: completions, and readers that go away.

use crate::common::data_path;
use crate::models::printed;
use std::process::{Command, Stdio};

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    for arguments in [
        vec!["derivatives", &data_path("robots/caroca.json"), "--pose", "0,0,1.75", "--payload", "50"],
        vec!["robot", "check", &data_path("robots/caroca.json")],
        vec!["completions", "bash"],
    ] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_cdpr"))
            .args(&arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{arguments:?}: {output:?}");
    }
}

#[test]
fn every_shell_gets_completions_of_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = printed(&["completions", shell]);
        for word in ["catenary", "workspace", "massless"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}
