//! Names of types, and the spelling of words.

use syn::{Item, Visibility};

/// The public types of a file: structs, enumerations, traits, aliases.
pub(crate) fn public_types(text: &str) -> Vec<String> {
    let name = |item: &Item| {
        let (visibility, name) = match item {
            Item::Struct(item) => (&item.vis, &item.ident),
            Item::Enum(item) => (&item.vis, &item.ident),
            Item::Union(item) => (&item.vis, &item.ident),
            Item::Trait(item) => (&item.vis, &item.ident),
            Item::Type(item) => (&item.vis, &item.ident),
            _ => return None,
        };
        matches!(visibility, Visibility::Public(_)).then(|| name.to_string())
    };
    syn::parse_file(text).unwrap().items.iter().filter_map(name).collect()
}

/// Beginnings of verbs that end in -ize here.
const STEMS: [&str; 17] = [
    "discret",
    "factor",
    "general",
    "initial",
    "linear",
    "maxim",
    "minim",
    "normal",
    "optim",
    "orthogonal",
    "random",
    "recogn",
    "serial",
    "standard",
    "summar",
    "symmetr",
    "vector",
];

/// Their other spelling begins so, and what may follow.
const OTHER: &str = "is";
const ENDS: [&str; 4] = ["e", "ing", "ation", "able"];

/// The words of a text that are spelled otherwise here.
pub(crate) fn other_spellings(text: &str) -> Vec<&str> {
    let is_other = |word: &&str| {
        let word = word.to_ascii_lowercase();
        let ends = |rest: &str| ENDS.iter().any(|end| rest.starts_with(end));
        let rest = |stem: &&str| word.split_once(*stem)?.1.strip_prefix(OTHER).filter(|rest| ends(rest));
        STEMS.iter().any(|stem| rest(stem).is_some())
    };
    text.split(|sign: char| !sign.is_alphabetic()).filter(is_other).collect()
}

/// Old or poetic words. Write: next to or compared with, again, identify or show, instead of.
const OLD: [&str; 6] = [" beside ", " anew ", " tell ", " tells ", " told ", " in place of "];

/// The old words of a text.
pub(crate) fn old_words(text: &str) -> Vec<&'static str> {
    let words = text.split_whitespace().map(|word| word.trim_matches(|c: char| !c.is_alphanumeric()));
    let plain = format!(" {} ", words.collect::<Vec<_>>().join(" ").to_lowercase());
    OLD.into_iter().filter(|word| plain.contains(*word)).map(str::trim).collect()
}

#[test]
fn old_words_are_found_over_the_ends_of_lines() {
    assert_eq!(old_words("It stands In\nplace of (beside) others."), ["beside", "in place of"]);
    assert!(old_words("besides, placed, telling").is_empty());
}

#[test]
fn words_have_one_spelling() {
    let text = ["linear", "isation of an optim", "ised maxim", "izer, random, minimis, optimistic"].concat();
    assert_eq!(other_spellings(&text).len(), 2);
}

#[test]
fn private_types_are_not_public() {
    let text = "pub struct A; struct B; pub(crate) enum C {} pub enum D {} mod e { pub struct A; }";
    assert_eq!(public_types(text), ["A", "D"]);
}
