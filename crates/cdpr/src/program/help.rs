//! The help of the whole program: its commands in groups, each group with an example; and manual pages.
//!
//! Names and sentences are those of the commands themselves.

use crate::program::error::ProgramError;
use clap::Command;
use std::path::{Path, PathBuf};

/// A group of commands.
struct Group {
    title: &'static str,
    /// Commands with their own commands below them.
    commands: &'static [&'static str],
    example: &'static str,
}

const GROUPS: [Group; 8] = [
    Group {
        title: "A robot at a pose",
        commands: &[
            "inverse",
            "direct",
            "deflection",
            "stiffness",
            "modes",
            "simulate",
            "response",
            "capacity",
            "safety",
            "derivatives",
            "hysteresis",
        ],
        example: "cdpr deflection caroca --pose 0,0,1.75 --payload 50",
    },
    Group {
        title: "A robot at many poses",
        commands: &["path", "workspace", "design", "explore"],
        example: "cdpr explore cogiro",
    },
    Group {
        title: "A table of numbers",
        commands: &["analyse"],
        example: "cdpr analyse data/tables/ishigami.csv",
    },
    Group { title: "Robots and their files", commands: &["robot"], example: "cdpr robot show cogiro" },
    Group {
        title: "Studies: which uncertain parameters matter",
        commands: &["study"],
        example: "cdpr study run data/studies/caroca.json --out results",
    },
    Group { title: "Calibration", commands: &["calibrate"], example: "cdpr calibrate fit --help" },
    Group {
        title: "A cable alone",
        commands: &["cable"],
        example: "cdpr cable density --mass 0.203 --length 2",
    },
    Group {
        title: "The program",
        commands: &["completions", "man"],
        example: "cdpr completions bash > cdpr.bash",
    },
];

/// The program's arguments, whose help has the commands in groups.
pub(crate) fn grouped(command: Command) -> Command {
    let mut text = String::new();
    for group in &GROUPS {
        text += &format!("{}:\n", group.title);
        for line in group.commands.iter().flat_map(|name| lines(&command, &[name])) {
            text += &line;
        }
        text += &format!("  Example: {}\n\n", group.example);
    }
    command.help_template(format!(
        "{{about}}\n\n{{usage-heading}} {{usage}}\n\n{text}Options:\n{{options}}{{after-help}}"
    ))
}

/// The lines of a command, or of all commands below it.
fn lines(root: &Command, words: &[&str]) -> Vec<String> {
    let Some(command) = words.iter().try_fold(root, |command, word| command.find_subcommand(word)) else {
        return Vec::new();
    };
    let below: Vec<&str> = own(command).map(Command::get_name).collect();
    if below.is_empty() {
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        return vec![format!("  {:<19} {about}\n", words.join(" "))];
    }
    below.into_iter().flat_map(|name| lines(root, &[words, &[name]].concat())).collect()
}

/// The commands below a command, without the `help` that clap adds.
fn own(command: &Command) -> impl Iterator<Item = &Command> {
    command.get_subcommands().filter(|inner| inner.get_name() != "help")
}

/// Manual pages.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// The command of the page, such as `study run`; without it the page is that of the whole program.
    command: Vec<String>,
    /// Folder to write the pages of all commands to; made if missing.
    #[arg(short, long, value_name = "FOLDER", conflicts_with = "command")]
    out: Option<PathBuf>,
}

/// Prints the page of a command, or writes all pages.
pub(crate) fn man(settings: &Settings, mut root: Command) -> Result<(), ProgramError> {
    // Names of pages, versions and arguments that all commands have.
    root.build();
    if let Some(folder) = &settings.out {
        std::fs::create_dir_all(folder).map_err(ProgramError::unwritten(folder))?;
        let pages = write(&root, folder)?;
        println!("{pages} pages in {}", folder.display());
        return Ok(());
    }
    let mut command = &root;
    for word in &settings.command {
        command = command.find_subcommand(word).ok_or_else(|| {
            let names: Vec<&str> = own(command).map(Command::get_name).collect();
            ProgramError::Usage(format!(
                "no command is called `{word}`: expected one of {}",
                names.join(", ")
            ))
        })?;
    }
    println!("{}", String::from_utf8_lossy(&page(command)).trim_end());
    Ok(())
}

/// Writes the pages of a command and of all below it; their number.
fn write(command: &Command, folder: &Path) -> Result<usize, ProgramError> {
    let path = folder.join(format!("{}.1", name(command)));
    std::fs::write(&path, page(command)).map_err(ProgramError::unwritten(&path))?;
    own(command).try_fold(1, |pages, inner| Ok(pages + write(inner, folder)?))
}

/// `cdpr-study-run`.
fn name(command: &Command) -> String {
    command.get_display_name().unwrap_or(command.get_name()).to_owned()
}

fn page(command: &Command) -> Vec<u8> {
    let mut page = Vec::new();
    // Writing to memory cannot fail.
    let _ = clap_mangen::Man::new(command.clone()).title(name(command)).render(&mut page);
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_command_is_in_one_group_and_each_line_of_the_help_fits_a_terminal() {
        let command = crate::program::command();
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|group| group.commands).copied().collect();
        let mut all: Vec<&str> = own(&command).map(Command::get_name).collect();
        grouped.sort_unstable();
        all.sort_unstable();
        assert_eq!(grouped, all);
        let text = crate::program::command().render_help().to_string();
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }

    #[test]
    fn the_examples_of_the_help_have_valid_arguments() {
        for group in &GROUPS {
            let words = group.example.split(" > ").next().unwrap_or_default().split(' ');
            if let Err(error) = crate::program::command().try_get_matches_from(words) {
                assert!(!error.use_stderr(), "{}: {error}", group.example);
            }
        }
    }
}
