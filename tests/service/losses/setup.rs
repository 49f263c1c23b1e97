//! A service with a few jobs, whose stores can be taken away.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use sqlx::{Connection, SqliteConnection};
use tempfile::TempDir;

use crate::harness::clock::Clock;
use crate::harness::postgres::Postgres;
use crate::harness::program;
use crate::harness::s3::S3;
use crate::meshes;
use crate::server::{Server, json};

/// Jobs of a service, and files of each that are compared.
const JOBS: u32 = 3;
/// The SQLite database with its log.
const SQLITE: [&str; 3] = ["unwrapd.sqlite", "unwrapd.sqlite-wal", "unwrapd.sqlite-shm"];

/// PostgreSQL and S3.
struct Shared {
    postgres: Postgres,
    s3: S3,
}

impl Shared {
    /// Waits until no connection of a killed service is left.
    fn disconnect(&self) {
        let left = "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity
             WHERE datname = 'unwrapd'";
        while self.postgres.psql("postgres", left) != "0\n" {
            std::thread::yield_now();
        }
    }
}

/// A service, its stores, and what its jobs made.
pub struct Setup {
    pub server: Server,
    pub jobs: Vec<Value>,
    made: Vec<BTreeMap<String, Vec<u8>>>,
    settings: Vec<(String, String)>,
    shared: Option<Shared>,
    /// Of the service and of the database.
    pub clock: Clock,
    _other: Option<TempDir>,
}

impl Setup {
    /// SQLite and a folder.
    pub async fn alone() -> Self {
        Self::of(None, Clock::ahead(0)).await
    }

    /// PostgreSQL and S3.
    pub async fn shared() -> Self {
        let clock = Clock::ahead(0);
        let postgres = Postgres::with(clock.settings());
        postgres.database("unwrapd");
        let s3 = S3::on(tempfile::tempdir().expect("a folder"), &clock.settings());
        Self::of(Some(Shared { postgres, s3 }), clock).await
    }

    async fn of(shared: Option<Shared>, clock: Clock) -> Self {
        let mut settings = clock.settings();
        if let Some(Shared { postgres, s3 }) = &shared {
            settings.extend(s3.settings());
            let url = format!("postgres://unwrapd@127.0.0.1:{}/unwrapd", postgres.port());
            settings.push(("UNWRAPD_DATABASE_URL".to_owned(), url));
        }
        let server = Server::on(tempfile::tempdir().expect("a folder"), &settings);
        let mut setup = Self {
            server,
            jobs: Vec::new(),
            made: Vec::new(),
            settings,
            shared,
            clock,
            _other: None,
        };
        for n in 0..JOBS {
            setup.add(n).await;
        }
        setup
    }

    /// Submits one more job and waits for its end.
    pub async fn add(&mut self, n: u32) {
        let job = self.server.submit(meshes::hills(1), &query(n)).await;
        let job = self.server.ended(&job).await;
        assert_eq!(job["state"], "succeeded", "{job}");
        self.made.push(self.files(&job).await);
        self.jobs.push(job);
    }

    /// Submits what made a job again, as it is when it has ended, and whether it was a copy.
    pub async fn again(&self, n: u32) -> (Value, bool) {
        let job = self.server.submit(meshes::hills(1), &query(n)).await;
        let is_copy = job["cached"] == true;
        (self.server.ended(&job).await, is_copy)
    }

    async fn files(&self, job: &Value) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        for file in job["links"]["files"].as_array().expect("links") {
            let href = file["href"].as_str().expect("a link").to_owned();
            let answer = self.server.get(&href).send().await.expect("an answer");
            assert_eq!(answer.status(), 200, "{href}");
            let bytes = answer.bytes().await.expect("a whole file");
            files.insert(href, bytes.to_vec());
        }
        files
    }

    /// Asserts that all jobs are there with the files that they made.
    pub async fn assert_whole(&self) {
        for (job, made) in self.jobs.iter().zip(&self.made) {
            let path = job["links"]["self"].as_str().expect("a link");
            let now = json(self.server.get(path).send().await.expect("an answer")).await;
            assert_eq!(now["state"], "succeeded", "{now}");
            assert!(self.files(&now).await == *made, "{now}");
        }
    }

    pub fn stop(&mut self) {
        self.server.kill();
    }

    pub fn start(&mut self) {
        self.server.restart();
    }

    /// Why the service does not start.
    pub fn refusal(&self) -> String {
        let mut command = Command::new(program());
        command
            .args(["serve", "--listen", "127.0.0.1:0", "--data"])
            .arg(self.server.data())
            .envs(self.settings.iter().cloned())
            .stdout(Stdio::piped());
        let output = command.output().expect("it runs");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{said}");
        let last = said.lines().last().unwrap_or_default();
        assert!(last.starts_with("unwrapd: "), "{said}");
        last.to_owned()
    }

    /// What `unwrapd check` prints with these arguments, and its exit status.
    pub fn check(&self, arguments: &[&str]) -> (i32, Value) {
        let output = Command::new(program())
            .args(["check", "--json", "--data"])
            .arg(self.server.data())
            .args(arguments)
            .envs(self.settings.iter().cloned())
            .output()
            .expect("it runs");
        let code = output.status.code().expect("a status");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let printed = serde_json::from_slice(&output.stdout);
        (code, printed.unwrap_or_else(|_| panic!("{said}")))
    }

    /// Where files of jobs lie.
    pub fn files_root(&self) -> PathBuf {
        match &self.shared {
            Some(shared) => shared.s3.root(),
            None => self.server.data().join("blobs"),
        }
    }

    /// How many files of jobs there are.
    pub fn count_files(&self) -> usize {
        let mut count = 0;
        for job in std::fs::read_dir(self.files_root())
            .into_iter()
            .flatten()
            .flatten()
        {
            let kinds = std::fs::read_dir(job.path())
                .into_iter()
                .flatten()
                .flatten();
            count += kinds.map(|kind| entries(&kind.path())).sum::<usize>();
        }
        count
    }

    /// A stored file of a job: the first one of its input or of its output.
    pub fn stored(&self, job: usize, kind: &str) -> PathBuf {
        let id = self.jobs[job]["id"].as_str().expect("an id");
        let mut folders = std::fs::read_dir(self.files_root().join(id)).expect("a folder");
        let found = folders.find(|folder| {
            let name = folder.as_ref().expect("an entry").file_name();
            name.to_string_lossy().starts_with(kind)
        });
        found.expect("a folder").expect("an entry").path().join("0")
    }

    /// Keeps the records as they are now, under another name.
    pub async fn keep_records(&self, name: &str) {
        if let Some(shared) = &self.shared {
            shared.disconnect();
            let template = format!("CREATE DATABASE {name} TEMPLATE unwrapd");
            shared.postgres.psql("postgres", &template);
            return;
        }
        let url = format!("sqlite://{}", self.server.data().join(SQLITE[0]).display());
        let mut records = SqliteConnection::connect(&url).await.expect("a database");
        let to = self.kept(name);
        std::fs::create_dir_all(&to).expect("a folder");
        sqlx::query("VACUUM INTO $1")
            .bind(to.join(SQLITE[0]).to_str())
            .execute(&mut records)
            .await
            .expect("a copy");
    }

    /// Puts the present records aside under a name, and those of another name in their place, or
    /// none.
    pub fn exchange_records(&self, aside: &str, instead: Option<&str>) {
        if let Some(shared) = &self.shared {
            shared.disconnect();
            let psql = |statement: String| shared.postgres.psql("postgres", &statement);
            psql(format!("ALTER DATABASE unwrapd RENAME TO {aside}"));
            psql(match instead {
                Some(name) => format!("ALTER DATABASE {name} RENAME TO unwrapd"),
                None => "CREATE DATABASE unwrapd".to_owned(),
            });
            return;
        }
        let data = self.server.data();
        move_all(data, &self.kept(aside));
        if let Some(name) = instead {
            move_all(&self.kept(name), data);
        }
    }

    /// Removes the records and puts others in their place.
    pub fn replace_records(&self, by: &str) {
        self.exchange_records(&format!("gone_{by}"), Some(by));
    }

    /// Where SQLite databases of a name are kept.
    fn kept(&self, name: &str) -> PathBuf {
        self.server.data().join(format!("kept-{name}"))
    }

    /// Changes records.
    pub async fn sql(&self, statement: &'static str) {
        if let Some(shared) = &self.shared {
            shared.postgres.psql("unwrapd", statement);
            return;
        }
        let url = format!("sqlite://{}", self.server.data().join(SQLITE[0]).display());
        let mut records = SqliteConnection::connect(&url).await.expect("a database");
        let done = sqlx::query(statement).execute(&mut records).await;
        done.expect("a statement");
    }
}

fn query(n: u32) -> String {
    format!("cut=disk&resolution={}", 256 + n)
}

fn entries(folder: &Path) -> usize {
    std::fs::read_dir(folder).map_or(0, Iterator::count)
}

fn move_all(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder");
    for name in SQLITE {
        // There is no log after a clean end.
        let _ = std::fs::remove_file(to.join(name));
        let _ = std::fs::rename(from.join(name), to.join(name));
    }
}

/// Flips a bit in the middle of a file.
pub fn damage(file: &Path) {
    let mut bytes = std::fs::read(file).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    // It may have a second name in a folder of an attempt.
    std::fs::remove_file(file).expect("a file");
    std::fs::write(file, bytes).expect("a file");
}
