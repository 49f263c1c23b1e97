//! Arguments for the location of records.

use std::path::{Path, PathBuf};

use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};

use super::failure::Failure;
use super::privacy::{Database, make_private};
use unwrapd_server::jobs::Rules;
use unwrapd_server::store::RecordStore;

/// Where records are.
#[derive(clap::Args)]
pub(super) struct StoreArgs {
    /// Folder for what this process keeps; created if missing. Without `database`, that is
    /// everything
    #[arg(
        long,
        value_name = "DIR",
        env = "UNWRAPD_DATA",
        default_value = "./data"
    )]
    pub data: PathBuf,
    /// PostgreSQL database for job records and keys, shared with other processes:
    /// postgres://USER:PASSWORD@HOST/NAME
    #[arg(
        long,
        value_name = "URL",
        env = "UNWRAPD_DATABASE_URL",
        hide_env_values = true
    )]
    pub database: Option<String>,
}

impl StoreArgs {
    /// Returns the URL of the database.
    pub fn database_url(&self) -> Result<String, String> {
        if let Some(database) = &self.database {
            return Ok(database.clone());
        }
        Ok(format!(
            "sqlite://{}?mode=rwc",
            url_path(&self.data.join("unwrapd.sqlite"))?
        ))
    }

    /// Opens the database, and creates it if needed.
    pub async fn opened(&self) -> Result<RecordStore, Failure> {
        self.make_folder().map_err(Failure::other)?;
        let url = self.database_url().map_err(Failure::other)?;
        let store = RecordStore::open(&url, Rules::default()).await;
        store.map_err(|error| Failure::other(format!("cannot use the database: {error}")))
    }

    /// Opens the database. Fails if it does not exist.
    pub async fn present(&self) -> Result<RecordStore, Failure> {
        let file = self.data.join("unwrapd.sqlite");
        if self.database.is_none() && !file.exists() {
            return Err(Failure::other(format!(
                "there is no database {}: name the folder of the service with --data",
                file.display()
            )));
        }
        self.opened().await
    }

    /// Creates the data folder, and protects it and all files created from now on from other users.
    pub fn make_folder(&self) -> Result<(), String> {
        let database = match self.database {
            None => Database::Here,
            Some(_) => Database::Elsewhere,
        };
        make_private(&self.data, database)
    }
}

/// Encodes a path for a URL.
pub(super) fn url_path(path: &Path) -> Result<String, String> {
    let path = std::path::absolute(path).map_err(|error| error.to_string())?;
    let path = path.to_string_lossy();
    let parts = path.split('/');
    let parts: Vec<_> = parts
        .map(|part| utf8_percent_encode(part, NON_ALPHANUMERIC).to_string())
        .collect();
    Ok(parts.join("/"))
}
