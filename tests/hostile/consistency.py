# SPDX-License-Identifier: MIT
"""What cannot hold of one answer of lacuna: sentences and numbers that contradict each other.

faults(command, text, json) looks at an answer with status 0. tests/support/consistency.hpp keeps
the same rules for the tests in C++; both are held to contradictions.json.

Usage: consistency.py ANSWER...   (files: what was printed, or JSON)
       consistency.py --table contradictions.json
"""
import json as json_module
import math
import re
import sys

GAP = 1.5            # times its noise floor that a gap of an explained record may be
SEEN = 0.002         # share of the spread below which a gap is of no size
SIGNIFICANT = 3.0    # standard deviations
TIME_IS_UP = "the time limit came first"
OPEN = 2.0           # noise floors, be it by chance or not
UNDETERMINED = 1e6   # half an interval over its number from which on a word has to be said
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
NOT_FINITE = re.compile(r"(?<![\w.])[-+]?(?:nan|inf|infinity)(?![\w.])", re.IGNORECASE)


def faults(command, text="", json=None):
    """Words for what contradicts itself in the answer of `command` (the arguments, as a shell
    reads them), given what it printed and its JSON, where there is one."""
    if isinstance(text, bytes):
        text = text.decode("utf-8", "replace")
    if isinstance(command, (list, tuple)):
        command = " ".join(command)
    found = []
    if json is None and text.lstrip().startswith("{"):
        try:
            json = json_module.loads(text)
        except ValueError:
            return ["JSON that cannot be read"]
    if json is None:
        found += text_faults(command, text)
    else:
        found += json_faults(json, "")
        kind = str(json.get("format", "")) if isinstance(json, dict) else ""
        rules = RULES.get(kind.split("/")[0])
        if rules:
            found += rules(json)
    return sorted(set(found))


# --- what is printed ----------------------------------------------------------------------------

def text_faults(command, text):
    if text.lstrip().lower().startswith(("<!doctype", "<svg", "<?xml")):
        text = re.sub(r"<[^>]*>", " ", re.sub(r"(?s)<(script|style).*?</\1>", " ", text))
    text = re.sub(r"\n +", " ", text)  # sentences are folded
    found = []
    if not NOT_FINITE.search(command) and NOT_FINITE.search(text):
        found.append("a number that is not finite")
    if re.search(r"\+- -?0(?![.\d])", text):
        found.append("an interval of width 0")
    for value, half in re.findall("(%s)\\s+\\+- (%s)" % (NUMBER, NUMBER), text):
        if float(half) > UNDETERMINED * abs(float(value)) > 0.0:
            found.append("%s +- %s without a word" % (value, half))
    if has_all(text, "Fits to the noise", "does not fit"):
        found.append("fits to the noise, and does not")
    if has_all(text, "Fits to the noise", "Does not hold"):
        found.append("fits to the noise, and does not hold")
    if has_all(text, "Wrong library", ": fits to the noise") and ": does not fit" not in text:
        found.append("wrong library, and every equation fits to the noise")
    if has_all(text, "Wrong library", " Holds: "):
        found.append("wrong library, and holds")
    if re.search(r"gap 0 -> 0(?![.\d])", text) or re.search(r"rmse 0[ ,].*fit 0 %", text):
        found.append("nothing compared, shown as perfect")
    if re.search(r"samples ahead 0(?![.\d])", text) and re.search(r"rmse [1-9]", text):
        found.append("nothing predicted, shown as perfect")
    return found


def has_all(text, *parts):
    return all(part in text for part in parts)


# --- JSON ---------------------------------------------------------------------------------------

def json_faults(value, path):
    """What holds of all of them: numbers are finite, intervals hold their number and have a
    width, and stay in the range that was given; an adequacy is that of its parts."""
    found = []
    if isinstance(value, dict):
        found += interval_faults(value, path)
        if path.endswith("/adequacy") and value["fits"] == "yes" and (
                not value["samples"] or any(part["fits"] == "no" for part in value["parts"])):
            found.append(path + " fits on nothing, or denies a part")
        for key, part in value.items():
            found += json_faults(part, path + "/" + str(key))
    elif isinstance(value, list):
        for i, part in enumerate(value):
            found += json_faults(part, "%s/%d" % (path, i))
    elif isinstance(value, float) and not math.isfinite(value):
        found.append(path + " is not finite")
    return found


def first_number(entry, *names):
    for name in names:
        if is_number(entry.get(name)):
            return entry[name]
    return None


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def interval_faults(entry, path):
    interval = entry.get("ci95")
    value = first_number(entry, "value", "coefficient", "estimated")
    low, high = entry.get("min"), entry.get("max")
    found = []
    if value is not None and ((is_number(low) and value < low) or (is_number(high) and value > high)):
        found.append(path + " is outside its range")
    if is_number(entry.get("stderr")) and entry["stderr"] <= 0.0:
        found.append(path + " has an error of 0")
    if not (isinstance(interval, list) and len(interval) == 2 and all(map(is_number, interval))):
        return found
    if not interval[0] < interval[1]:
        found.append(path + " has an interval of width 0")
    if value is not None and not interval[0] <= value <= interval[1]:
        found.append(path + " is outside its interval")
    if (is_number(low) and interval[0] < low) or (is_number(high) and interval[1] > high):
        found.append(path + " has an interval outside its range")
    if value and (interval[1] - interval[0]) / 2.0 > UNDETERMINED * abs(value):
        found.append(path + " has an interval that says nothing")
    return found


def identification_faults(json):
    found = []
    fits = [fit.get("fits_to_noise") for fit in json.get("fit", []) if not fit.get("identity")]
    verdict = json.get("verdict")
    if verdict == "fits to noise" and False in fits:
        found.append("fits to noise, and an equation does not")
    if verdict == "wrong library" and fits and all(fits):
        found.append("wrong library, and every equation fits to the noise")
    for fit in json.get("fit", []):
        if fit.get("residual") == 0.0 and fit.get("target") == 0.0 and fit.get("fits_to_noise"):
            found.append("nothing to explain, and it fits to the noise")
    validation = json.get("validation") or {}
    if json.get("adequacy", {}).get("fits") == "yes" and verdict not in (None, "fits to noise"):
        found.append("fits to the noise, and " + verdict)
    if validation and not validation.get("samples") and verdict != "cannot tell":
        found.append("a verdict on no samples")
    if verdict == "fits to noise" and validation.get("held_out") == "parts" and not any(
            test.get("states") for test in (validation["one_step"], validation["windows"])):
        found.append("a verdict on no predictions")
    sync = json.get("sync") or {}
    if sync:
        found += sync_faults(sync)
    if verdict == "fits to noise" and "Does not hold" in sync.get("sentence", ""):
        found.append("fits to noise, and does not hold")
    if verdict == "wrong library" and sync.get("holds"):
        found.append("wrong library, and holds")
    return found


def diagnosis_faults(json):
    verdict, effects = json.get("verdict"), json.get("effects", [])
    remaining = json.get("remaining") or {}
    gap = json.get("gap") or {}
    found = []
    if verdict in ("no-discrepancy", "coefficients-only", "unnamed-structure") and effects:
        found.append(verdict + " with effects")
    if verdict in ("explained", "partly-explained") and not effects:
        found.append(verdict + " without effects")
    whole = ("explained", "no-discrepancy", "coefficients-only")
    if verdict in whole and remaining.get("structure"):
        found.append(verdict + " with structure left")
    if verdict in whole:
        after, floor = gap.get("after"), gap.get("noise_floor")
        if not is_number(after) or not is_number(floor):
            if verdict == "explained":
                found.append("explained without a gap")
        elif after > max(GAP * floor, SEEN) and is_above(gap):
            found.append("%s beside a gap of %g and a floor of %g" % (verdict, after, floor))
    cut = [one["stage"] for one in json.get("stages", []) if one.get("why") == TIME_IS_UP]
    if cut and verdict != "incomplete":
        found.append("%s, and %s were left out" % (verdict, ", ".join(cut)))
    if (verdict in ("incomplete", "undetermined")) != bool(json.get("why")):
        found.append("%s without a reason, or with one that is none" % verdict)
    if gap and gap.get("before") == 0 and gap.get("after") == 0:
        found.append("a gap of nothing")
    return found


def is_above(gap):
    sigma = gap.get("above_floor")
    return (not (is_number(sigma) and sigma < SIGNIFICANT)
            or gap["after"] > OPEN * gap["noise_floor"])


def fit_faults(json):
    found = []
    for quality in json.get("fit", []) + ((json.get("gap") or {}).get("channels") or []):
        ahead = quality.get("k_step", {})
        if quality.get("rmse") is not None and quality.get("samples") == 0:
            found.append("an error of no samples")
        if ahead.get("rmse") is not None and ahead.get("samples") == 0:
            found.append("a prediction of no samples")
        if quality.get("rmse") == 0.0 and quality.get("fit_percent") == 0.0:
            found.append("nothing compared, shown as perfect")
        if ahead.get("rmse") == 0.0 and (quality.get("rmse") or 0.0) > 0.0:
            found.append("nothing predicted, shown as perfect")
    gap = json.get("gap")
    if gap and gap.get("before") == 0 and gap.get("after") == 0:
        found.append("a gap of nothing")
    open_numbers = [number for number in json.get("parameters", [])
                    if number.get("ci95") is None and not number.get("bound")
                    and not number.get("per_record")]
    said = [member for one in json.get("combinations", []) for member in one["members"]]
    if json.get("identifiable") and open_numbers:
        found.append("identifiable, and %s has no interval" % open_numbers[0]["name"])
    found += [number["name"] + " has no interval without a word" for number in open_numbers
              if number["name"] not in said]
    return found


def sync_faults(json):
    found = []
    sentence = json.get("sentence", "")
    if json.get("holds") != sentence.startswith("Holds: "):
        found.append("holds, and does not")
    if json.get("holds") and not json.get("settled"):
        found.append("holds, and did not settle")
    if json.get("holds") and json.get("status") != "completed":
        found.append("holds, and did not get to the end")
    return found


def comparison_faults(json):
    if not json.get("agree"):
        return []
    judged = [measure for measure in json.get("measures", []) if measure.get("agree")]
    if not judged:
        return ["agreement of nothing"]
    return ["agreement by an interval that says nothing" for measure in judged
            if any(not all(map(is_number, measure[key])) for key in ("first_ci95", "second_ci95"))]


RULES = {
    "lacuna.identification": identification_faults,
    "lacuna.diagnosis": diagnosis_faults,
    "lacuna.fit": fit_faults,
    "lacuna.sync": sync_faults,
    "lacuna.comparison": comparison_faults,
}


def table_faults(rows):
    """Rows of contradictions.json in which other faults are found than stand there."""
    wrong = []
    for row in rows:
        found = faults("", row["text"], row["json"])
        if (row["fault"] not in "; ".join(found)) if row["fault"] else found:
            wrong.append("%r: found %r in %s" % (row["fault"], found, row["text"] or row["json"]))
    return wrong


def main(arguments):
    found = []
    if arguments[:1] == ["--table"]:
        with open(arguments[1]) as stream:
            found = table_faults(json_module.load(stream))
    for path in [] if arguments[:1] == ["--table"] else arguments:
        with open(path) as stream:
            found += ["%s: %s" % (path, fault) for fault in faults("", stream.read())]
    print("\n".join(found) if found else "no contradiction")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
