//! Findings for machines that show them to people: SARIF 2.1.0, JUnit XML, GitHub's workflow commands.
//! A failed asset is shown like a finding of severity error.

use crate::options::Format;
use crate::said::AssetReport;
use foliar_schema::{CODES, Finding, Severity};
use serde_json::{Value, json};

/// Code under which a failure is shown.
const FAILED: &str = "FAILED";

/// The findings of all assets in this format; nothing for formats that tell them as they go. JUnit knows no levels: what
/// is as serious as `failure` fails.
pub fn text(format: Format, reports: &[AssetReport], failure: Severity) -> Option<String> {
    match format {
        Format::Human | Format::Json => None,
        Format::Sarif => Some(format!("{:#}", sarif(reports))),
        Format::Junit => Some(junit(reports, failure)),
        Format::Github => Some(reports.iter().flat_map(findings).map(|f| github(&f)).collect::<Vec<_>>().join("\n")),
    }
}

fn findings(report: &AssetReport) -> Vec<Finding> {
    let mut findings = report.findings.clone();
    findings.extend(report.error.as_ref().map(|message| Finding {
        code: FAILED.into(),
        severity: Severity::Error,
        message: message.clone(),
        place: None,
        file: Some(report.asset.clone()),
    }));
    findings
}

/// Line of a text file, where the place is one.
fn line(finding: &Finding) -> Option<u64> {
    finding.place.as_ref()?.strip_prefix("line ")?.parse().ok()
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

fn sarif(reports: &[AssetReport]) -> Value {
    let failed = rule(FAILED, "The file could not be worked on: the message says why.", Severity::Error);
    let rules = CODES.iter().map(|info| rule(info.code, info.doc, info.severity)).chain([failed]);
    let result = |finding: Finding| {
        let uri = finding.file.as_deref().map(uri).unwrap_or_default();
        // GitHub shows nothing without a line; what has none belongs to the whole file.
        let region = json!({"startLine": line(&finding).unwrap_or(1)});
        let mut location = json!({"physicalLocation": {"artifactLocation": {"uri": uri}, "region": region}});
        if let (None, Some(place)) = (line(&finding), &finding.place) {
            location["logicalLocations"] = json!([{"fullyQualifiedName": place}]);
        }
        json!({
            "ruleId": finding.code,
            "level": severity(finding.severity),
            "message": {"text": finding.message},
            "locations": [location],
        })
    };
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": {"driver": {
                "name": "foliar",
                "version": env!("CARGO_PKG_VERSION"),
                "rules": rules.collect::<Vec<_>>(),
            }},
            "results": reports.iter().flat_map(findings).map(result).collect::<Vec<_>>(),
        }],
    })
}

/// A code as SARIF knows it, with all that GitHub's code scanning asks for.
fn rule(code: &str, doc: &str, level: Severity) -> Value {
    json!({
        "id": code,
        "shortDescription": {"text": doc},
        "fullDescription": {"text": doc},
        "help": {"text": format!("{doc} More: foliar explain {code}.")},
        "defaultConfiguration": {"level": severity(level)},
    })
}

/// A path as a URI reference: SARIF knows nothing else.
fn uri(path: &str) -> String {
    const KEPT: percent_encoding::AsciiSet =
        percent_encoding::NON_ALPHANUMERIC.remove(b'/').remove(b'.').remove(b'-').remove(b'_').remove(b'~');
    let encoded = |path: &str| percent_encoding::utf8_percent_encode(path, &KEPT).to_string();
    let path = path.replace('\\', "/");
    match path.split_at_checked(2) {
        _ if path.starts_with('/') => format!("file://{}", encoded(&path)),
        Some((drive, rest)) if drive.ends_with(':') && rest.starts_with('/') => {
            format!("file:///{drive}{}", encoded(rest))
        }
        _ => encoded(&path),
    }
}

/// One suite per asset.
fn junit(reports: &[AssetReport], failure: Severity) -> String {
    let suites: String = reports.iter().map(|report| suite(report, failure)).collect();
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"foliar\">\n{suites}</testsuites>")
}

fn suite(report: &AssetReport, failure: Severity) -> String {
    let name = xml(&report.asset);
    let all = findings(report);
    let failed = all.iter().filter(|finding| finding.severity >= failure).count();
    let case = |finding: &Finding| {
        let text = xml(&format!("{}: {}", finding.place.as_deref().unwrap_or("file"), finding.message));
        let open = format!("<testcase classname=\"{name}\" name=\"{}\">", xml(&finding.code));
        let said = if finding.severity >= failure {
            let first = xml(finding.message.lines().next().unwrap_or_default());
            format!("<failure type=\"{}\" message=\"{first}\">{text}</failure>", severity(finding.severity))
        } else {
            format!("<system-out>{text}</system-out>")
        };
        format!("    {open}{said}</testcase>\n")
    };
    let bake =
        if failed == 0 { format!("    <testcase classname=\"{name}\" name=\"no faults\"/>\n") } else { String::new() };
    let cases: String = all.iter().map(case).collect();
    let tests = all.len() + usize::from(failed == 0);
    format!("  <testsuite name=\"{name}\" tests=\"{tests}\" failures=\"{failed}\">\n{bake}{cases}  </testsuite>\n")
}

/// Text as XML has it; control characters that XML has not are left out.
fn xml(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    text.chars().filter(|c| (!c.is_control() || *c == '\n') && !matches!(c, '\u{FFFE}' | '\u{FFFF}')).collect()
}

fn github(finding: &Finding) -> String {
    let word = if finding.severity == Severity::Note { "notice" } else { severity(finding.severity) };
    let data = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let property = |text: &str| data(text).replace(':', "%3A").replace(',', "%2C");
    let line = line(finding).map_or_else(String::new, |line| format!(",line={line}"));
    let file = property(finding.file.as_deref().unwrap_or_default());
    // A place that is no line would be lost.
    let place = finding.place.as_ref().filter(|_| line.is_empty()).map_or_else(String::new, |p| format!("{p}: "));
    format!("::{word} file={file}{line},title={}::{}{}", finding.code, data(&place), data(&finding.message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_schema::code;

    fn report() -> AssetReport {
        let finding = Finding::new(&code::IMPORT_MTL, "a <b> & \"c\",\n50 %").at("line 7").in_file("a,b.obj");
        let error = Some("broken".into());
        AssetReport { asset: "a,b.obj".into(), findings: vec![finding], error, ..AssetReport::default() }
    }

    #[test]
    fn sarif_names_rule_level_file_and_line() {
        let all = sarif(&[report()]);
        let result = &all["runs"][0]["results"][0];
        assert_eq!((&result["ruleId"], &result["level"]), (&"IMPORT-MTL".into(), &"warning".into()));
        let place = &result["locations"][0]["physicalLocation"];
        assert_eq!(
            (&place["artifactLocation"]["uri"], &place["region"]["startLine"]),
            (&"a%2Cb.obj".into(), &7.into())
        );
        assert_eq!(all["runs"][0]["results"][1]["ruleId"], "FAILED");
        let rules = all["runs"][0]["tool"]["driver"]["rules"].as_array().unwrap();
        assert_eq!(rules.len(), CODES.len() + 1, "every code that a result may name is a rule");
    }

    #[test]
    fn a_path_from_the_root_is_a_whole_uri() {
        let uris = ["a b.obj", "/x/ü.obj", "C:\\x\\a.obj"].map(uri);
        assert_eq!(uris, ["a%20b.obj", "file:///x/%C3%BC.obj", "file:///C:/x/a.obj"]);
    }

    #[test]
    fn junit_counts_and_escapes() {
        let text = junit(&[report()], Severity::Warning);
        assert!(text.contains("tests=\"2\" failures=\"2\""), "{text}");
        assert!(text.contains("a &lt;b&gt; &amp; &quot;c&quot;"), "{text}");
        assert!(text.contains("<failure type=\"warning\" message=\"a &lt;b&gt; &amp; &quot;c&quot;,\">"), "{text}");
        // The failure of the file itself is an error; the finding is a warning.
        let text = junit(&[report()], Severity::Error);
        assert!(text.contains("failures=\"1\"") && text.contains("<system-out>line 7: a"), "{text}");
        let clean = junit(&[AssetReport { asset: "a.obj".into(), ..AssetReport::default() }], Severity::Error);
        assert!(clean.contains("tests=\"1\" failures=\"0\"") && clean.contains("name=\"no faults\""), "{clean}");
    }

    #[test]
    fn github_escapes_what_its_commands_are_made_of() {
        let all = text(Format::Github, &[report()], Severity::Error).unwrap();
        let first = all.lines().next().unwrap();
        assert_eq!(first, "::warning file=a%2Cb.obj,line=7,title=IMPORT-MTL::a <b> & \"c\",%0A50 %25");
        let placed = Finding::new(&code::STALE, "changed").at("/meshes/0").in_file("a.glb");
        assert_eq!(github(&placed), "::warning file=a.glb,title=STALE::/meshes/0: changed");
    }
}
