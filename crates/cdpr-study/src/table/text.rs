//! Bytes to text, with one kind of line end.

use crate::table::error::TableError;

/// The text of bytes in UTF-8, UTF-16 with its mark, or Latin-1, without a mark in front.
pub(super) fn decoded(bytes: &[u8]) -> Result<String, TableError> {
    let no_text = |found| Err(TableError::NoText { found });
    if bytes.starts_with(b"PK\x03\x04") {
        return no_text("a workbook or another archive");
    }
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => Some(narrow(rest)),
        _ => Some(narrow(bytes)),
    };
    let Some(text) = text else { return no_text("UTF-16 with an error in it") };
    if text.chars().any(|letter| letter.is_ascii_control() && !matches!(letter, '\t' | '\n' | '\r' | '\x0c'))
    {
        return no_text("no text");
    }
    Ok(text.replace("\r\n", "\n").replace(['\r', '\x0c'], "\n"))
}

/// Text of one byte a letter, where it is not UTF-8: spreadsheets still write it.
fn narrow(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// Text of UTF-16.
fn wide(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Option<String> {
    let (pairs, []) = bytes.as_chunks::<2>() else { return None };
    char::decode_utf16(pairs.iter().map(|pair| unit(*pair))).collect::<Result<_, _>>().ok()
}
