//! Processes that others started, as the system lists them.

use std::path::Path;

/// Process ids of the children that compute jobs and sessions, and work within a folder.
pub fn within(folder: &Path) -> Vec<i32> {
    let folder = folder.to_string_lossy();
    let is_child = |pid: &i32| {
        let command = std::fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
        let command = String::from_utf8_lossy(&command).replace('\0', " ");
        let is_ours = [" compute ", " session "];
        is_ours.iter().any(|word| command.contains(word)) && command.contains(&*folder)
    };
    all().filter(is_child).collect()
}

/// Process ids of those that a process started.
pub fn of(parent: u32) -> Vec<i32> {
    let is_child = |pid: &i32| stat(*pid).is_some_and(|(_, of)| of == parent);
    all().filter(is_child).collect()
}

/// Whether a process can still do anything.
pub fn is_alive(pid: i32) -> bool {
    stat(pid).is_some_and(|(state, _)| state != "Z" && state != "X")
}

fn all() -> impl Iterator<Item = i32> {
    let entries = std::fs::read_dir("/proc").expect("/proc");
    entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok())
}

/// The state and the parent of a process.
fn stat(pid: i32) -> Option<(String, u32)> {
    let text = std::fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    // The name, which may have spaces, stands in parentheses.
    let mut fields = text.rsplit_once(')')?.1.split_whitespace();
    Some((fields.next()?.to_owned(), fields.next()?.parse().ok()?))
}
