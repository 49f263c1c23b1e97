//! Text of others, made safe for a terminal.

use std::borrow::Cow;

/// A text without characters that a terminal acts upon: what is not printed is escaped, but for the ends of lines and tabs.
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

/// A name of one line: that of a file, which may have any character but one.
pub(super) fn one_line(name: &str) -> String {
    let name = name.replace('\n', "\\n").replace('\t', "\\t");
    escaped(&name).into_owned()
}
