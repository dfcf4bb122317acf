# SPDX-License-Identifier: MIT
"""Records whose numbers, times or units say something else than they seem to."""
import gzip
import io
import math
import struct
import zipfile

from cases import Case, npy

ROWS = 60
NANO = 10 ** 9
EPOCH = 1700000000 * NANO


def signal(i):
    return math.cos(0.1 * i)


def stamps(origin, step):
    return [origin + step * i for i in range(ROWS)]


def csv(times, header="t,x", text=str):
    rows = ["%s,%.9f" % (text(time), signal(i)) for i, time in enumerate(times)]
    return ("%s\n%s\n" % (header, "\n".join(rows))).encode()


def seconds(digits):
    """Nanoseconds as seconds with so many digits."""
    def text(time):
        whole, rest = divmod(time, NANO)
        return "%d.%s" % (whole, ("%09d" % rest)[:digits])
    return text


def array(times, kind="<q", shape=None):
    data = b"".join(struct.pack(kind, time) for time in times)
    name = {"q": "i8", "Q": "u8", "d": "f8", "f": "f4"}[kind[-1]]
    return npy("{'descr': '%s%s', 'fortran_order': False, 'shape': %s, }\n"
               % (kind[0], name, shape or "(%d,)" % len(times)), data)


def records(times, kind):
    """Times and a signal as a structured array."""
    name = {"q": "i8", "Q": "u8"}[kind[-1]]
    data = b"".join(struct.pack(kind[0] + kind[-1] + "d", time, signal(i))
                    for i, time in enumerate(times))
    return npy("{'descr': [('t', '%s%s'), ('x', '%sf8')], 'fortran_order': False, "
               "'shape': (%d,), }\n" % (kind[0], name, kind[0], len(times)), data)


def archive(members, pack=zipfile.ZIP_STORED):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", pack) as file:
        for name, content in members.items():
            file.writestr(name, content)
    return stream.getvalue()


def columns(times, kind="<q"):
    return {"t.npy": array(times, kind),
            "x.npy": array([signal(i) for i in range(len(times))], "<d")}


def mat(times, signed=True):
    """MATLAB 5, not packed."""
    def variable(name, kind, type_, data):
        name = name.ljust(8, b"\0")
        body = struct.pack("<8I", 6, 8, kind, 0, 5, 8, len(times), 1)
        body += struct.pack("<2I", 1, len(name.rstrip(b"\0"))) + name
        body += struct.pack("<2I", type_, len(data)) + data
        return struct.pack("<2I", 14, len(body)) + body
    whole = b"".join(struct.pack("<q" if signed else "<Q", time) for time in times)
    real = b"".join(struct.pack("<d", signal(i)) for i in range(len(times)))
    return (b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM" +
            variable(b"t", 14 if signed else 15, 12 if signed else 13, whole) +
            variable(b"x", 6, 9, real))


def stamp_cases():
    """Times beyond doubles: counted from the first one, in every kind of file."""
    for step in [1, 100, 1000, 10 ** 6, NANO, 86400 * NANO]:
        for origin in [EPOCH + 1, 9 * 10 ** 18 + 7, 10 ** 19 - 60 * 86400 * NANO + 1]:
            times = stamps(origin, step)
            kind = "<q" if times[-1] < 2 ** 63 else "<Q"
            files = {"r.csv": csv(times, "t [ns],x"), "r.npy": records(times, kind),
                     "b.npy": records(times, ">" + kind[1]), "r.npz": archive(columns(times, kind)),
                     "r.mat": mat(times, kind == "<q")}
            for name, content in files.items():
                yield Case("stamps: %s from %d by %d" % (name, origin, step), "check " + name, 0,
                           "counted from the first one, %d," % origin, {name: content})
    for digits, step in [(6, 1000), (6, 10 ** 6), (9, 1), (9, 100), (9, NANO)]:
        times = stamps(EPOCH + 123456789 // 10 ** (9 - digits) * 10 ** (9 - digits), step)
        yield Case("stamps: %d decimals by %d" % (digits, step), "check r.csv", 0,
                   "counted from the first one", {"r.csv": csv(times, "t [s],x", seconds(digits))})
    yield Case("stamps: a step of 100 ns is no pause", "identify r.csv --degree 1 --embed x=2", 0,
               "Equations", {"r.csv": csv(stamps(EPOCH, 100), "t [ns],x")})
    yield Case("stamps: that stand still", "identify r.csv", 2, "stands still",
               {"r.csv": csv([EPOCH] * ROWS, "t [ns],x")})
    yield Case("stamps: that go back by one", "identify r.csv", 2, "r.csv:62:1",
               {"r.csv": csv(stamps(EPOCH, 100) + [EPOCH + 99 * 59], "t [ns],x")})
    for unit, scale in [("ms", 10 ** 6), ("us", 10 ** 3), ("ns", 1)]:
        times = [time // scale for time in stamps(EPOCH, 10 ** 8)]
        yield Case("stamps: %s since 1970" % unit, "check r.csv", 0, "--time-unit " + unit,
                   {"r.csv": csv(times)})


def resolution_cases():
    """Times that are too coarse for their steps."""
    for digits, step in [(3, 1400000), (2, 17000000), (4, 133000)]:
        yield Case("coarse: %d digits" % digits, "check r.csv", 0, "% of their step",
                   {"r.csv": csv(stamps(0, step), "t,x", seconds(digits))})
    times = [1.7e9 + 1.1e-6 * i for i in range(ROWS)]
    yield Case("coarse: doubles since 1970", "check r.npz", 0, "% of their step",
               {"r.npz": archive(columns(times, "<d"))})
    yield Case("coarse: singles", "check r.npz", 0, "% of their step",
               {"r.npz": archive(columns([1000 + 1.13e-3 * i for i in range(ROWS)], "<f"))})


def clock_cases():
    def log(clocks):
        rows = ["%s,%.6f" % (clock, signal(i)) for i, clock in enumerate(clocks)]
        return ("time,x\n" + "\n".join(rows) + "\n").encode()
    day = ["2026-02-27 10:00:%02d" % i for i in range(20)]
    for wrong, part in {
            "2026-02-30 10:00:20": "month 2 of 2026 has 28 days",
            "2026-02-29 10:00:20": "has 28 days", "2026-04-31 10:00:20": "has 30 days",
            "2026-13-01 10:00:20": "no month 13", "2026-00-01 10:00:20": "no month 0",
            "2026-02-00 10:00:20": "has 28 days", "2026-02-28 25:00:00": "a day ends at 24:00",
            "2026-02-28 24:00:01": "a day ends at 24:00", "2026-02-28 10:60:00": "no minute 60",
            "2026-02-28 10:00:61": "no second 61", "2026-02-28 10:00:60": "leap seconds",
            "2026-02-28 10:00:99.5": "no second 99.5", "2026-02-28 10:00:00Z": "it has a zone",
            "2026-02-28 10:00:00+01:00": "it has a zone", "10:00:20": "it has no date",
            "2026-02-28 10:00:00 CET": "it has a zone", "noon": "is not a number"}.items():
        yield Case("clock: " + wrong, "identify r.csv", 2, "r.csv:22:1", {"r.csv": log(day + [wrong])})
        yield Case("clock: why not " + wrong, "check r.csv", 2, part, {"r.csv": log(day + [wrong])})
        if part != "is not a number":
            yield Case("clock: first " + wrong, "check r.csv", 2, "r.csv:",
                       {"r.csv": log([wrong] + day)})
    zoned = ["2026-10-25T02:59:%02d+02:00" % i for i in range(40, 60)]
    zoned += ["2026-10-25T02:00:%02d+01:00" % i for i in range(20)]
    spring = ["2026-03-29T01:59:%02d+01:00" % i for i in range(40, 60)]
    spring += ["2026-03-29T03:00:%02d+02:00" % i for i in range(20)]
    leap = ["2016-12-31T23:59:%02dZ" % i for i in range(40, 61)]
    leap += ["2017-01-01T00:00:%02dZ" % i for i in range(19)]
    for name, clocks in {"end of daylight saving": zoned, "begin of daylight saving": spring,
                         "leap second": leap,
                         "zones without colons": [c[:-3] + c[-2:] for c in zoned],
                         "zones behind a blank": [c[:-6] + " " + c[-6:] for c in zoned]}.items():
        yield Case("clock: " + name, "check r.csv", 0, "step 1 s", {"r.csv": log(clocks)})
        yield Case("clock: identify at the " + name, "identify r.csv --degree 1", 0, "Equations",
                   {"r.csv": log(clocks)})
    blanks = "".join("%s %s %s %.6f\n" % (c[:10], c[11:19], c[19:].replace(":", ""), signal(i))
                     for i, c in enumerate(zoned))
    yield Case("clock: a zone in a column of its own", "check r.txt", 0, "step 1 s",
               {"r.txt": blanks.encode()})


def unit_cases():
    times = list(range(ROWS))
    for header, unit in {
            "time_ms": "ms", "Time in ms": "ms", "millis": "ms", "t_us": "us", "timestamp_ns": "ns",
            "timestampNs": "ns", "Time ms": "ms", "t/ms": "ms", "time_min": "min", "Zeit_h": "h",
            "microseconds": "us", "elapsed.d": "d"}.items():
        yield Case("unit: in the name " + header, "check r.csv", 0,
                   "the time is in %s, as the name of column" % unit,
                   {"r.csv": csv(times, header + ",x")})
    for header in ["t (ms)", "t [msec]", "Time(ms)", "time [Milliseconds]"]:
        yield Case("unit: " + header, "check r.csv", 0, "step 1 ms",
                   {"r.csv": csv(times, header + ",x")})
    for names, units in [("Time,Speed", "ms,rpm"), ("t,x", "ms,-"), ("Zeit,w", "[ms],[1/s]"),
                         ("stamp,x", "msec,m/s^2"), ("Time,x", "ms,")]:
        yield Case("unit: in the line below, " + units, "check r.csv", 0, "step 1 ms",
                   {"r.csv": csv(times, names + "\n" + units)})
    for header, part in {"t_min": "--time-unit min", "x_h": "--time-unit h", "time_m": "--time-unit",
                         "frame": "--dt", "Sample": "--dt", "time_ms [s]": "not in ms"}.items():
        yield Case("unit: perhaps, " + header, "check r.csv", 0, part,
                   {"r.csv": csv(times, header + ",y")})
    yield Case("unit: the time is found by it", "check r.csv", 0, "step 1 ms",
               {"r.csv": ("x,time_ms\n" + "".join(
                   "%.9f,%d\n" % (signal(i), i) for i in times)).encode()})


def comma_cases():
    def rows(separator, field, count=20, time="%d"):
        return ("t%sx\n" % separator + "".join(
            (time % i) + separator + field(i) + "\n" for i in range(count))).encode()
    for name, content in {
            "quoted in commas": rows(",", lambda i: '"1,%03d"' % i),
            "a sign": rows(",", lambda i: '"-12,%03d"' % i),
            "one of them": rows(",", lambda i: '"1,5"' if i < 19 else '"1,500"'),
            "beside points": rows(",", lambda i: "0.5" if i else '"0,5"'),
            "in semicolons beside points": rows(";", lambda i: "1,%03d" % i, time="0.%03d"),
            "in tabs beside points": rows("\t", lambda i: "1,%03d" % i, time="0.%03d"),
            "beside clocks": rows(",", lambda i: '"1,%03d"' % i, time="10:00:%02d")}.items():
        yield Case("comma: " + name, "identify r.csv", 2, "may be one of decimals or of thousands",
                   {"r.csv": content})
    for name, content in {
            "decimals in semicolons": rows(";", lambda i: "%d,%03d" % (i, 7 * i % 10)),
            "decimals in quotes": rows(",", lambda i: '"%d,%d"' % (i, 7 * i % 10)),
            "decimals after a zero": rows(",", lambda i: '"0,%03d"' % (7 * i))}.items():
        yield Case("comma: " + name, "check r.csv", 0, "x", {"r.csv": content})


def archive_cases():
    good = columns([0.1 * i for i in range(ROWS)], "<d")
    single = struct.pack("<d", 100.0)
    text = npy("{'descr': '<U1', 'fortran_order': False, 'shape': (60,), }\n", b"a\0\0\0" * 60)
    members = {
        "fs": npy("{'descr': '<f8', 'fortran_order': False, 'shape': (), }\n", single),
        "who": text,
        "cube": array([1.0] * 120, "<d", "(60, 2, 1)"),
        "complex": npy("{'descr': '<c16', 'fortran_order': False, 'shape': (60,), }\n",
                       bytes(960)),
        "object": npy("{'descr': '|O', 'fortran_order': False, 'shape': (60,), }\n", b"\x80\x04."),
        "none": array([], "<d"),
    }
    for name, content in members.items():
        for pack in [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED]:
            yield Case("npz: %s, packing %d" % (name, pack), "check r.npz", 0,
                       "'%s' is neither a vector nor a matrix" % name,
                       {"r.npz": archive(dict(good, **{name + ".npy": content}), pack)})
    yield Case("npz: a text beside arrays", "check r.npz", 0, "'notes.txt' is neither",
               {"r.npz": archive(dict(good, **{"notes.txt": b"made by hand"}))})
    yield Case("npz: nothing but a number", "check r.npz", 2, "no array of numbers",
               {"r.npz": archive({"fs.npy": members["fs"]})})
    whole = archive(good)
    for at in [whole.index(b"NUMPY") + 200, whole.index(b"PK\1\2") - 1]:
        bad = whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:]
        yield Case("npz: a bit at %d" % at, "check r.npz", 2, "checksum", {"r.npz": bad})
    packed = gzip.compress(csv([0.1 * i for i in range(ROWS)]))
    for name, rest in {"a line": b"6.0,1\n", "one byte": b"\x1f", "text behind zeros": bytes(50) + b"x",
                       "another kind": b"PK\3\4" + bytes(20)}.items():
        for command in ["check", "identify --memory 100M"]:
            yield Case("gz: %s behind it, %s" % (name, command), command + " r.csv.gz", 2,
                       "behind the compressed data", {"r.csv.gz": packed + rest})
    yield Case("gz: zeros behind it", "check r.csv.gz", 0, "step 0.1 s",
               {"r.csv.gz": packed + bytes(512)})
    yield Case("gz: two members", "check r.csv.gz", 0, "step 0.1 s",
               {"r.csv.gz": gzip.compress(b"t,x\n") + gzip.compress(csv(
                   [0.1 * i for i in range(ROWS)]).partition(b"\n")[2])})


def workbook(cells, shared="<si><t>x</t></si>"):
    """An .xlsx of one sheet: time, and a signal whose name is shared text 0."""
    rows = ['<row r="1"><c r="A1" t="str"><v>t</v></c><c r="B1" t="s"><v>0</v></c></row>']
    rows += ['<row r="%d"><c r="A%d"><v>%.1f</v></c><c r="B%d"><v>%.9f</v></c></row>'
             % (i + 2, i + 2, 0.1 * i, i + 2, signal(i)) for i in range(ROWS)]
    name = "http://schemas.openxmlformats.org/package/2006/relationships"
    return archive({
        "xl/workbook.xml": '<workbook xmlns:r="r"><sheets><sheet name="S" r:id="rId1"/></sheets>'
                           "</workbook>",
        "xl/_rels/workbook.xml.rels": '<Relationships xmlns="%s"><Relationship Id="rId1" '
                                      'Target="worksheets/a.xml"/></Relationships>' % name,
        "xl/sharedStrings.xml": "<sst>%s</sst>" % shared,
        "xl/worksheets/a.xml": "<worksheet><sheetData>%s%s</sheetData></worksheet>"
                               % ("".join(rows), cells)}, zipfile.ZIP_DEFLATED)


def sheet_cases():
    lines = "".join('<row r="%d"><c r="A%d"><v>%d</v></c></row>' % (i, i, i)
                    for i in range(100, 20000))
    for name, cells, part in [
            ("a stray cell", lines + '<row r="20000"><c r="XFD20000"><v>1</v></c></row>',
             "more cells than any record"),
            ("a cell beyond all", '<row r="9999999999"><c r="ZZZZ1"><v>1</v></c></row>',
             "more cells than any record"),
            ("a text that is not there", '<row r="62"><c r="A62" t="s"><v>1</v></c></row>',
             "names a text that is not there"),
            ("tags in one another", "<a>" * 200000 + "</a>" * 200000, None)]:
        yield Case("sheet: " + name, "check r.xlsx", 2 if part else 0, part or "step 0.1 s",
                   {"r.xlsx": workbook(cells)})


def wide_cases():
    for count in [400, 3000]:
        header = ",".join(["t"] + ["c%d" % k for k in range(count)])
        rows = [",".join(["%d" % i] + ["%d" % (i * k % 97) for k in range(count)])
                for i in range(12)]
        yield Case("wide: %d columns" % count, "check r.csv", 0, "c%d" % (count - 1),
                   {"r.csv": "\n".join([header] + rows).encode()})


def minus_cases():
    plain = csv([0.1 * i for i in range(ROWS)])
    yield Case("minus: of typesetting", "identify r.csv --degree 1 --embed x=2", 0, "Equations",
               {"r.csv": plain.replace(b"-", "\u2212".encode())})
    yield Case("minus: alone", "check r.csv", 0, "that a value is missing",
               {"r.csv": plain + "6,\u2212\n".encode()})


def cases():
    found = []
    for make in [stamp_cases, resolution_cases, clock_cases, unit_cases, comma_cases,
                 archive_cases, sheet_cases, wide_cases, minus_cases]:
        found += make()
    return found
