//! Compute children, as the system lists them.

use std::path::Path;

/// Process ids of the compute children that work within a folder.
pub fn within(folder: &Path) -> Vec<i32> {
    let folder = folder.to_string_lossy();
    let is_child = |pid: &i32| {
        let command = std::fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
        let command = String::from_utf8_lossy(&command).replace('\0', " ");
        command.contains(" compute ") && command.contains(&*folder)
    };
    let entries = std::fs::read_dir("/proc").expect("/proc");
    let names = entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok());
    names.filter(is_child).collect()
}
