//! The benches in Python still run: the smallest case of each table.

mod shared {
    use std::process::Command;

    use crate::places;

    /// What a script prints.
    fn printed(script: &str, arguments: &[&str]) -> String {
        let output = Command::new(places::python())
            .arg(places::repository("tests/bench").join(script))
            .arg("--reference")
            .arg(places::shared("reference"))
            .args(["--unwrapd", env!("CARGO_BIN_EXE_unwrapd")])
            .args(arguments)
            .output()
            .expect("a Python");
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{error}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    #[test]
    #[ignore = "needs ../shared"]
    fn the_papers_tables_are_drawn() {
        let text = printed("paper", &["--quick", "--ipopt-seconds", "0"]);
        for title in [
            "Table 1",
            "Timings of the figures",
            "Figure 18",
            "Figure 20",
        ] {
            let table = text.split("\n## ").find(|part| part.starts_with(title));
            let Some(table) = table else {
                assert!(
                    text.contains(&format!("skipped: {title}")),
                    "{title}: {text}"
                );
                continue;
            };
            assert_not_inverted(table);
        }
    }

    /// Asserts that a table has results, none of which is inverted but without a barrier; of those
    /// that failed the number is a dash.
    fn assert_not_inverted(table: &str) {
        let rows: Vec<Vec<&str>> = table
            .lines()
            .filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"))
            .map(|line| line.split(" | ").collect())
            .collect();
        let (header, results) = rows.split_first().expect("a header");
        assert!(!results.is_empty(), "{table}");
        let column = header.iter().position(|cell| *cell == "inverted");
        let column = column.expect("a column");
        let has_no_barrier = |row: &[&str]| {
            row.iter().any(|cell| {
                cell.starts_with("none") || cell.ends_with("_none") || cell.starts_with("Lipman")
            })
        };
        for row in results.iter().filter(|row| !has_no_barrier(row)) {
            assert!(["0", "–"].contains(&row[column]), "{row:?}");
        }
    }

    #[test]
    #[ignore = "needs ../shared"]
    fn bijective_maps_are_judged() {
        let text = printed("bijective.py", &["woody-lo_pt_swapAL_arap_spline"]);
        // Crossings, status and distance to the targets with `bijective`.
        assert!(text.contains(" | 0 | converged | 0 | "), "{text}");
    }

    #[test]
    #[ignore = "needs ../shared"]
    fn reference_problems_are_judged() {
        let checker = places::shared("tools/lim_check.py");
        let arguments = [
            "--checker",
            &checker.to_string_lossy(),
            "grid608_green_spline",
            "bar_c_bend_green_spline",
        ];
        let text = printed("reference.py", &arguments);
        for line in [
            "2 problems; inverted: none; targets missed: none",
            "energy more than 1 % above: none",
        ] {
            assert!(text.contains(line), "{text}");
        }
    }
}
