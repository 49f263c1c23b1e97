//! Seams: surfaces opened to disks.
