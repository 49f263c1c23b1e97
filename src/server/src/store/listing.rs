//! Pages of the job list.

use sqlx::query::Query;
use sqlx::{Any, AssertSqlSafe};

use super::database::Database;
use super::rows;
use super::within::within;
use crate::jobs::access::{Owner, Reach};
use crate::jobs::{Job, Listing, Order, State, StoreResult};
use unwrapd_api::Kind;

/// A bound value of a statement.
enum Value {
    Text(String),
    Number(i64),
}

/// Conditions joined by AND, with the values of their placeholders in order.
#[derive(Default)]
struct Conditions {
    texts: Vec<String>,
    values: Vec<Value>,
}

impl Conditions {
    /// Adds a condition, in which `?` is the placeholder of its value.
    fn add(&mut self, condition: &str, value: Value) {
        self.values.push(value);
        let place = format!("${}", self.values.len());
        self.texts.push(condition.replace('?', &place));
    }

    fn words(&mut self, condition: &str, word: Option<&str>) {
        if let Some(word) = word {
            self.add(condition, Value::Text(word.to_owned()));
        }
    }

    fn numbers(&mut self, condition: &str, number: Option<i64>) {
        if let Some(number) = number {
            self.add(condition, Value::Number(number));
        }
    }
}

/// Returns a page of jobs, without those of synchronous requests.
pub(super) async fn page(
    database: &Database,
    reach: &Reach,
    listing: &Listing,
) -> StoreResult<Vec<Job>> {
    let (within, owner) = within(reach, 1);
    let mut met = Conditions::default();
    met.texts.push(format!("ephemeral = 0 AND {within}"));
    met.values.push(Value::Text(owner.to_owned()));
    met.words("state = ?", listing.state.map(State::word));
    met.words("kind = ?", listing.kind.map(Kind::word));
    met.words("owner = ?", listing.owner.as_ref().map(Owner::as_str));
    met.numbers("? <= created", listing.since.map(|time| time.0));
    met.numbers("created < ?", listing.until.map(|time| time.0));
    let labelled = "id IN (SELECT job FROM label WHERE digest = ?)";
    for label in listing.metadata.labels() {
        met.add(labelled, Value::Text(label));
    }
    let (beyond, direction) = match listing.order {
        Order::NewestFirst => ("id < ?", "DESC"),
        Order::OldestFirst => ("? < id", "ASC"),
    };
    let after = listing.after.map(|id| id.to_string());
    met.words(beyond, after.as_deref());
    met.values.push(Value::Number(i64::from(listing.limit)));
    let page = format!(
        "SELECT {{columns}} FROM job WHERE {} ORDER BY id {direction} LIMIT ${}",
        met.texts.join(" AND "),
        met.values.len()
    );
    let found = bound(database.sql(&page), met.values)
        .fetch_all(&database.readers)
        .await?;
    found.iter().map(rows::job).collect()
}

fn bound(
    statement: AssertSqlSafe<String>,
    values: Vec<Value>,
) -> Query<'static, Any, <Any as sqlx::Database>::Arguments> {
    let statement = sqlx::query(statement);
    values
        .into_iter()
        .fold(statement, |query, value| match value {
            Value::Text(text) => query.bind(text),
            Value::Number(number) => query.bind(number),
        })
}
