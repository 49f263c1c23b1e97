//! Escaping of untrusted text for terminals.

use std::borrow::Cow;

/// Escapes characters that a terminal acts upon: control characters other than line breaks and tabs.
pub(super) fn escaped(text: &str) -> Cow<'_, str> {
    let is_active = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(is_active) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_active(c) {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

/// Returns a name as one escaped line. File names may contain any character but one.
pub(super) fn one_line(name: &str) -> String {
    let name = name.replace('\n', "\\n").replace('\t', "\\t");
    escaped(&name).into_owned()
}
