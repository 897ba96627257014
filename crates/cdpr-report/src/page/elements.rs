//! The document of every report, and the elements of its sections: figures, tables, numbers.

use crate::live::{UNPACK, data, models, policy, script};
use crate::text;
use cdpr_robot::{shown, shown_lines};
use cdpr_study::Figure;
use cdpr_web::page as explorer;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::borrow::Cow;

/// Style of every page.
const STYLE: &str = include_str!("page.css");

/// Part of a page in which no character of a name is obeyed.
fn inert(part: &Markup) -> PreEscaped<Cow<'_, str>> {
    PreEscaped(shown_lines(&part.0))
}

/// Content security policy of pages without scripts: styles of the page itself, and nothing else.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// A report: every kind has the same style, a header, and sections with a list of them.
pub(crate) struct Document<'a> {
    /// Title of the window.
    pub(crate) title: &'a str,
    /// Version of the program.
    pub(crate) version: &'a str,
    pub(crate) header: Markup,
    pub(crate) sections: Vec<Section>,
    /// The robot that computes in it.
    pub(crate) live: Option<Live<'a>>,
}

/// What a page needs for a robot that computes.
pub(crate) struct Live<'a> {
    /// Its window.
    pub(crate) dialog: Markup,
    /// The data of the page, as JSON.
    pub(crate) json: &'a str,
    /// The script of the page.
    pub(crate) script: &'static str,
}

impl Document<'_> {
    /// The text of an HTML file that needs no other file.
    pub(crate) fn write(&self) -> String {
        let policy = self.live.as_ref().map_or(POLICY.to_owned(), |live| policy(&[UNPACK, live.script]));
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(policy);
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    meta name="generator" content={ "cdpr " (self.version) };
                    title { (shown(self.title)) }
                    style { (PreEscaped(STYLE)) @if self.live.is_some() { (PreEscaped(explorer::STYLE)) } }
                }
                body {
                    a.skip href="#content" { "Skip to the content" }
                    div.page { (self.contents()) (self.main()) }
                    @if let Some(live) = &self.live {
                        (inert(&live.dialog))
                        (data(live.json))
                        (models())
                        (script(UNPACK))
                        (script(live.script))
                    }
                }
            }
        };
        page.into_string()
    }

    fn contents(&self) -> Markup {
        html! {
            nav aria-label="Contents" {
                ol {
                    li { a href="#content" { "At a glance" } }
                    @for section in &self.sections {
                        li { a href={ "#" (section.id) } { (shown(&section.title)) } }
                    }
                }
            }
        }
    }

    fn main(&self) -> Markup {
        html! {
            main id="content" {
                (inert(&self.header))
                @for section in &self.sections {
                    section id=(section.id) {
                        h2 { (shown(&section.title)) }
                        (inert(&section.body))
                    }
                }
                footer {
                    "Written by cdpr " (self.version) "."
                    @if self.live.is_some() { " The robot in space is drawn by three.js (MIT licence)." }
                }
            }
        }
    }
}

/// Section of the report.
pub(crate) struct Section {
    /// Anchor in the page.
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) body: Markup,
}

impl Section {
    pub(crate) fn new(id: impl Into<String>, title: impl Into<String>, body: Markup) -> Self {
        Self { id: id.into(), title: title.into(), body }
    }
}

/// The SVG text of a figure, or the reason why it was not drawn.
pub(crate) fn svg<'a>(figures: &'a [Figure], name: &str) -> Result<&'a str, &'a str> {
    let found = figures.iter().find(|figure| figure.name == name);
    let svg = found.map(|figure| figure.svg.as_deref().map_err(String::as_str));
    svg.unwrap_or(Err("it was not drawn"))
}

/// A figure with its description for screen readers and its caption, or the reason why it was not drawn.
pub(crate) fn figure(name: &str, alt: &str, figures: &[Figure], caption: &Markup) -> Markup {
    match svg(figures, name) {
        Ok(svg) => html! {
            figure id={ "figure-" (name) } {
                div.drawing role="img" aria-label=(alt) tabindex="0" { (PreEscaped(svg)) }
                figcaption { (caption) " " span.file { "File: " (name) ".svg" } }
            }
        },
        Err(error) => html! { p.note { "No figure " code { (name) } ": " (error) "." } },
    }
}

/// Table that scrolls sideways if it is too wide.
pub(crate) fn table(caption: &str, head: &[&str], rows: &[Vec<Markup>]) -> Markup {
    html! {
        div.table tabindex="0" role="region" aria-label=(caption) {
            table {
                caption { (caption) }
                thead { tr { @for cell in head { th scope="col" { (cell) } } } }
                tbody {
                    @for row in rows {
                        tr {
                            @for (column, cell) in row.iter().enumerate() {
                                @if column == 0 { th scope="row" { (cell) } } @else { td { (cell) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Cell of plain text.
pub(crate) fn cell(text: impl AsRef<str>) -> Markup {
    html! { (text.as_ref()) }
}

/// Cell of a number with this many significant digits, or a dash if there is no number.
pub(crate) fn numeric(value: impl Into<Option<f64>>, digits: usize) -> Markup {
    let value = value.into();
    html! { span.number { @match value { Some(value) => (text::figures(value, digits)), None => "\u{2013}" } }
    }
}
