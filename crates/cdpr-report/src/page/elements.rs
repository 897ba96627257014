//! Elements of the sections: figures, tables, numbers.

use crate::text;
use cdpr_robot::shown_lines;
use cdpr_study::Figure;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::borrow::Cow;

/// Style of every page.
pub(crate) const STYLE: &str = include_str!("page.css");

/// Part of a page in which no character of a name is obeyed.
pub(crate) fn inert(part: &Markup) -> PreEscaped<Cow<'_, str>> {
    PreEscaped(shown_lines(&part.0))
}

/// Content security policy of pages without scripts: styles of the page itself, and nothing else.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The text of an HTML file without scripts that needs no other file.
pub(crate) fn plain_page(title: &str, version: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content={ "cdpr " (version) };
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { div.page { main id="content" {
                (inert(body))
                footer { "Written by cdpr " (version) "." }
            } } }
        }
    };
    page.into_string()
}

/// Section of the report.
pub(crate) struct Section {
    /// Anchor in the page.
    pub(crate) id: &'static str,
    pub(crate) title: String,
    pub(crate) body: Markup,
}

impl Section {
    pub(crate) fn new(id: &'static str, title: impl Into<String>, body: Markup) -> Self {
        Self { id, title: title.into(), body }
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
