//! What stores lose or mix up: a database or files that are missing, empty, older or of another
//! service, damaged bytes, a clock that is wrong. No job and no file is lost over it, and no answer
//! is wrong: a start is refused, or what is damaged says so.

mod matrix;
mod setup;

use setup::Setup;

/// A test of each line of the matrix, on one machine and on many.
macro_rules! lines {
    ($($name:ident),* $(,)?) => {
        mod alone {
            $(#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
            async fn $name() {
                super::matrix::$name(super::Setup::alone().await).await;
            })*
        }

        mod postgres {
            $(#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
            async fn $name() {
                super::matrix::$name(super::Setup::shared().await).await;
            })*
        }
    };
}

lines!(
    a_missing_database_is_refused,
    an_older_database_deletes_nothing,
    the_database_of_another_service_is_refused,
    missing_files_are_refused,
    the_files_of_another_service_are_refused,
    a_store_of_an_earlier_version_is_adopted,
    a_damaged_record_gives_no_wrong_answer,
    a_damaged_input_fails_its_job,
    a_damaged_result_is_not_served_and_not_copied,
    a_missing_result_is_not_served_and_not_copied,
    a_clock_that_is_wrong_removes_nothing,
);
