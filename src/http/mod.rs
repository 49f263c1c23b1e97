//! Routes, problems, OpenAPI, progress, the page.
