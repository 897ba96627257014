//! `cargo xtask release`: sets the repository, the authors and the version wherever files name them.
//!
//! All files are changed in memory first: where a value is bad, or a place is missing, none is written.

use crate::cargo::{cargo, printed, read, root, write};
use std::collections::BTreeMap;

/// Files that name the repository.
const WITH_REPOSITORY: [&str; 6] = [
    "Cargo.toml",
    "CITATION.cff",
    "README.md",
    "crates/cdpr-python/pyproject.toml",
    "docs/book.toml",
    "recipe/recipe.yaml",
];

/// Manifest of the package for ROS.
const ROS: &str = "crates/cdpr-c/ros2/cdpr_ros/package.xml";

/// A value that cannot be set.
#[derive(Debug, PartialEq, thiserror::Error)]
pub(crate) enum ReleaseError {
    #[error("`{0}` is no option of `cargo xtask release`: expected --repository, --authors or --version")]
    Option(String),
    #[error("{0} is missing its value, or is given twice")]
    Value(&'static str),
    #[error("--repository and --authors are missing, and no --version is given: there is nothing to set")]
    Nothing,
    #[error("--repository is `{0}`: expected an address https://HOST/OWNER/cdpr without a slash at its end")]
    Repository(String),
    #[error(
        "--authors has `{0}`: expected `GIVEN NAMES FAMILY NAME <MAIL>`, several with a comma between them"
    )]
    Author(String),
    #[error(
        "--version is `{0}`: expected three numbers, such as 0.1.0, and perhaps a pre-release, 0.2.0-rc.1"
    )]
    Version(String),
    #[error("{file}: {field} is not where it is expected")]
    Place { file: &'static str, field: &'static str },
    #[error("{0}")]
    File(String),
}

/// What to set; `None` stays as it is.
#[derive(Debug, Default, PartialEq)]
struct Values {
    repository: Option<String>,
    authors: Option<Vec<Author>>,
    version: Option<String>,
}

#[derive(Debug, PartialEq)]
struct Author {
    given: String,
    family: String,
    mail: String,
}

/// Texts of files by their path in the repository.
type Files = BTreeMap<&'static str, String>;

pub(crate) fn run(rest: &[String]) -> Result<(), ReleaseError> {
    let values = Values::parse(rest)?;
    let today = printed("date", &["-u", "+%F"]).map_err(ReleaseError::File)?;
    let files = changed(&values, &today, |file| read(&root().join(file)).map_err(ReleaseError::File))?;
    for (file, text) in &files {
        write(&root().join(file), text).map_err(ReleaseError::File)?;
        eprintln!("written: {file}");
    }
    // The lock file has the versions of the workspace's own packages.
    cargo(&["update", "--workspace", "--offline", "--quiet"]).map_err(ReleaseError::File)
}

impl Values {
    fn parse(arguments: &[String]) -> Result<Self, ReleaseError> {
        let mut values = Self::default();
        for pair in arguments.chunks(2) {
            let value = pair.get(1).map(String::as_str);
            match pair[0].as_str() {
                "--repository" => once(&mut values.repository, value, "--repository", repository)?,
                "--authors" => once(&mut values.authors, value, "--authors", authors)?,
                "--version" => once(&mut values.version, value, "--version", version)?,
                other => return Err(ReleaseError::Option(other.to_owned())),
            }
        }
        if values == Self::default() { Err(ReleaseError::Nothing) } else { Ok(values) }
    }
}

/// Sets a value that is there, and has not been given before.
fn once<T>(
    place: &mut Option<T>,
    value: Option<&str>,
    option: &'static str,
    parse: fn(&str) -> Result<T, ReleaseError>,
) -> Result<(), ReleaseError> {
    match (place.is_some(), value) {
        (false, Some(value)) => *place = Some(parse(value)?),
        _ => return Err(ReleaseError::Value(option)),
    }
    Ok(())
}

fn repository(value: &str) -> Result<String, ReleaseError> {
    let path = value.strip_prefix("https://").unwrap_or_default();
    let is_plain = |part: &str| {
        !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric() || "-_.~".contains(c))
    };
    let is_address = path.split('/').count() >= 2 && path.split('/').all(is_plain) && !path.ends_with(".git");
    if is_address { Ok(value.to_owned()) } else { Err(ReleaseError::Repository(value.to_owned())) }
}

fn authors(value: &str) -> Result<Vec<Author>, ReleaseError> {
    let author = |text: &str| {
        let (name, rest) = text.trim().split_once(" <")?;
        let mail = rest.strip_suffix('>')?;
        let (given, family) = name.trim().rsplit_once(' ')?;
        let (user, host) = mail.split_once('@')?;
        let is_mail =
            !user.is_empty() && host.contains('.') && !host.contains('@') && !mail.contains([' ', '"']);
        let is_name = !name.contains(['"', '\'', '\\', '<', '>', ':', '[', '{', '#', '\n']);
        let [given, family, mail] = [given, family, mail].map(str::to_owned);
        (is_mail && is_name).then_some(Author { given, family, mail })
    };
    let one = |text: &str| author(text).ok_or_else(|| ReleaseError::Author(text.trim().to_owned()));
    value.split(',').map(one).collect()
}

fn version(value: &str) -> Result<String, ReleaseError> {
    let (core, before) = value.split_once('-').unwrap_or((value, "rc.1"));
    let is_number = |part: &str| part.parse::<u32>().is_ok_and(|number| number.to_string() == part);
    let is_word = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric());
    let is_version =
        core.split('.').count() == 3 && core.split('.').all(is_number) && before.split('.').all(is_word);
    if is_version { Ok(value.to_owned()) } else { Err(ReleaseError::Version(value.to_owned())) }
}

/// The files that differ with these values.
fn changed(
    values: &Values,
    today: &str,
    open: impl Fn(&'static str) -> Result<String, ReleaseError>,
) -> Result<Files, ReleaseError> {
    let mut files = Files::new();
    let mut edit = |file: &'static str, field: &'static str, change: &dyn Fn(&str) -> Option<String>| {
        let text = files.get(file).cloned().map_or_else(|| open(file), Ok)?;
        files.insert(file, change(&text).ok_or(ReleaseError::Place { file, field })?);
        Ok::<(), ReleaseError>(())
    };
    if let Some(new) = &values.repository {
        let manifest = open("Cargo.toml")?;
        let old = between(&manifest, "\nrepository = \"", "\"");
        let old = old.ok_or(ReleaseError::Place { file: "Cargo.toml", field: "repository" })?;
        for file in WITH_REPOSITORY {
            edit(file, "repository", &|text| text.contains(old).then(|| text.replace(old, new)))?;
        }
    }
    if let Some(authors) = &values.authors {
        let list = |each: &dyn Fn(&Author) -> String, separator: &str| {
            authors.iter().map(each).collect::<Vec<_>>().join(separator)
        };
        let full = |of: &Author| format!("{} {}", of.given, of.family);
        let cargo = list(&|of| format!("\"{} <{}>\"", full(of), of.mail), ", ");
        edit("Cargo.toml", "authors", &|text| set(text, "\nauthors = [", "]\n", &cargo))?;
        let python = list(&|of| format!("{{ name = \"{}\", email = \"{}\" }}", full(of), of.mail), ", ");
        edit("crates/cdpr-python/pyproject.toml", "authors", &|text| {
            set(text, "\nauthors = [", "]\n", &python)
        })?;
        let cited = |of: &Author| {
            format!(
                "  - family-names: {}\n    given-names: {}\n    email: {}\n",
                of.family, of.given, of.mail
            )
        };
        edit("CITATION.cff", "authors", &|text| set(text, "\nauthors:\n", "license:", &list(&cited, "")))?;
        edit(ROS, "maintainer", &|text| {
            let one = |of: &Author| format!(" email=\"{}\">{}</maintainer>", of.mail, full(of));
            set(text, "\n  <maintainer", "\n  <license>", &list(&one, "\n  <maintainer"))
        })?;
        let paper = |of: &Author| format!("  - name: {}\n    affiliation: 1\n", full(of));
        edit("docs/joss/paper.md", "authors", &|text| {
            set(text, "\nauthors:\n", "affiliations:", &list(&paper, ""))
        })?;
    }
    if let Some(new) = &values.version {
        edit("Cargo.toml", "version", &|text| {
            let old = between(text, "\nversion = \"", "\"")?.to_owned();
            let lines = text.lines().map(|line| {
                let is_ours = line.starts_with("version = ") || line.starts_with("cdpr");
                let [old, new] = [&old, new].map(|version| format!("version = \"{version}\""));
                if is_ours { line.replace(&old, &new) } else { line.to_owned() }
            });
            Some(lines.collect::<Vec<_>>().join("\n") + "\n")
        })?;
        edit("CITATION.cff", "version", &|text| set(text, "\nversion: ", "\n", new))?;
        edit("CITATION.cff", "date-released", &|text| set(text, "\ndate-released: ", "\n", today))?;
        edit("recipe/recipe.yaml", "version", &|text| set(text, "version: \"", "\"", new))?;
        // ROS has versions of three numbers alone.
        let numbers = new.split('-').next().unwrap_or(new);
        edit(ROS, "version", &|text| set(text, "\n  <version>", "</version>", numbers))?;
        edit("CHANGELOG.md", "the section Unreleased", &|text| {
            let heading = format!("\n## {new} ({today})\n");
            text.contains("\n## Unreleased\n").then(|| text.replacen("\n## Unreleased\n", &heading, 1))
        })?;
    }
    Ok(files)
}

/// What stands between two texts, the first time.
fn between<'a>(text: &'a str, begin: &str, end: &str) -> Option<&'a str> {
    text.split_once(begin)?.1.split_once(end).map(|(found, _)| found)
}

/// A text with another value between two texts, the first time.
fn set(text: &str, begin: &str, end: &str, value: &str) -> Option<String> {
    let (before, rest) = text.split_once(begin)?;
    let at = rest.find(end)?;
    Some(format!("{before}{begin}{value}{}", &rest[at..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(arguments: &[&str]) -> Result<Values, ReleaseError> {
        Values::parse(&arguments.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn every_place_of_this_repository_is_set_and_can_be_set_again() {
        let first = parsed(&[
            "--repository",
            "https://example.net/ropes/cdpr",
            "--authors",
            "Ada King <ada@example.net>, Grace Brewster Hopper <grace@example.net>",
            "--version",
            "3.1.4-rc.1",
        ]);
        let files = changed(&first.unwrap(), "2030-01-02", |file| {
            read(&root().join(file)).map_err(ReleaseError::File)
        });
        let files = files.unwrap();
        let has = |file: &str, text: &str| assert!(files[file].contains(text), "{file}: {}", files[file]);
        for file in WITH_REPOSITORY {
            has(file, "https://example.net/ropes/cdpr");
        }
        has("Cargo.toml", "authors = [\"Ada King <ada@example.net>\", \"Grace Brewster Hopper <");
        has("Cargo.toml", "\nversion = \"3.1.4-rc.1\"\n");
        has("Cargo.toml", "cdpr-web = { path = \"crates/cdpr-web\", version = \"3.1.4-rc.1\" }");
        has("CITATION.cff", "  - family-names: Hopper\n    given-names: Grace Brewster\n    email: grace@");
        has("CITATION.cff", "version: 3.1.4-rc.1\ndate-released: 2030-01-02\n");
        has("crates/cdpr-python/pyproject.toml", "{ name = \"Ada King\", email = \"ada@example.net\" }");
        has("docs/joss/paper.md", "  - name: Ada King\n    affiliation: 1\n  - name: Grace");
        has("recipe/recipe.yaml", "version: \"3.1.4-rc.1\"");
        has(ROS, "<version>3.1.4</version>");
        has(ROS, "<maintainer email=\"grace@example.net\">Grace Brewster Hopper</maintainer>\n  <license>");
        has("CHANGELOG.md", "\n## 3.1.4-rc.1 (2030-01-02)\n");
        let second = parsed(&["--repository", "https://example.net/b", "--authors", "B C <b@c.de>"]).unwrap();
        let again = changed(&second, "2030-01-03", |file| Ok(files[file].clone())).unwrap();
        assert!(again.values().all(|text| !text.contains("example.net/ropes") && !text.contains("Ada")));
        assert!(again["Cargo.toml"].contains("authors = [\"B C <b@c.de>\"]\n"));
    }

    #[test]
    fn bad_values_are_refused_by_the_name_of_their_field() {
        for repository in
            ["", "cdpr", "http://a.de/b", "https://a.de", "https://a.de/b/", "https://a.de/b\"c"]
        {
            let refused = ReleaseError::Repository(repository.to_owned());
            assert_eq!(parsed(&["--repository", repository]), Err(refused));
        }
        for author in ["", "Ada", "Ada King", "Ada King <ada>", "Ada King <ada@home>", "A \"B <a@b.de>"] {
            assert_eq!(parsed(&["--authors", author]), Err(ReleaseError::Author(author.to_owned())));
        }
        for version in ["", "1", "1.2", "1.2.3.4", "v1.2.3", "1.02.3", "1.2.3-", "1.2.3-a b"] {
            assert_eq!(parsed(&["--version", version]), Err(ReleaseError::Version(version.to_owned())));
        }
        assert_eq!(parsed(&["--version"]), Err(ReleaseError::Value("--version")));
        assert_eq!(parsed(&[]), Err(ReleaseError::Nothing));
        assert_eq!(parsed(&["--name", "a"]), Err(ReleaseError::Option("--name".to_owned())));
    }
}
