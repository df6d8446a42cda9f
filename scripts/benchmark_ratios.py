"""Ratios of a benchmark report, each with its spread, and which of them changed."""
import math

SIGNIFICANT = 3  # spreads that a change must exceed
LEAST_CHANGE = 0.03  # relative: below it spreads of a few passes say too little


def ratio(value, spread):
    return {"value": round(value, 4), "spread": round(spread, 4)}


def platform(part, device):
    """Short enough for a key: the platform's first word, of PoCL its common name."""
    name = part["devices"][device]["platform"]
    return "PoCL" if name == "Portable Computing Language" else name.split()[0]


def at_time(points, seconds):
    """relMSE after so many CPU seconds, along straight lines in logarithms; None outside of the points or where it is not known."""
    known = [(point["cpuSeconds"], point["relMse"]) for point in points if point["relMse"] and point["relMse"] > 0]
    for (t0, e0), (t1, e1) in zip(known, known[1:]):
        if t0 <= seconds <= t1 and t1 > t0:
            share = math.log(seconds / t0) / math.log(t1 / t0)
            return math.exp((1 - share) * math.log(e0) + share * math.log(e1))
    return None


def error_ratios(part):
    """Standard over other methods at equal CPU time: at the latest common time, spread by the times before it."""
    runs = {(run["device"], run["method"]): run for run in part["runs"]}
    for (device, method), run in runs.items():
        standard = runs.get((device, "standard:0"))
        if method == "standard:0" or standard is None:
            continue
        found = []
        last = min(run["points"][-1]["cpuSeconds"], standard["points"][-1]["cpuSeconds"])
        for seconds in (last / 4, last / 2, last):
            error, of_standard = at_time(run["points"], seconds), at_time(standard["points"], seconds)
            if error and of_standard:
                found.append(of_standard / error)
        if found:
            ours = "quasi-specular" if method == "scene" else method
            yield f"relMSE standard / {ours}, {run['scene']}, {platform(part, device)}", ratio(
                found[-1], (max(found) - min(found)) / 2)


def kernel_ratios(part):
    for one in part.get("kernels", []):
        found = one["genericOverScene"]["pass"]
        yield f"generic / scene kernels, {one['scene']}, {platform(part, one['device'])}", ratio(
            found["ratio"], found["standardError"])


def thread_ratios(part):
    """Where other programs took a tenth of the cores or more, the speed-up is theirs, and left out."""
    for one in part.get("threads", []):
        for point in one["points"][1:]:
            if point["pass"]["cpu"] < 0.9 * point["threads"] * point["pass"]["clock"]:
                continue
            yield f"{point['threads']} threads / 1, {one['scene']}, {platform(part, one['device'])}", ratio(
                point["speedUp"]["pass"], point["rounds"]["standardError"])


def device_ratios(part):
    """Of costs of a pass, by CPU seconds where both are CPUs; one measurement each, so the spread is not known."""
    compared = part.get("deviceComparison", [])
    for one in compared[1:]:
        on_cpus = all(part["devices"][each["device"]]["isCpu"] for each in (one, compared[0]))
        key = "cpu" if on_cpus else "clock"
        names = f"{platform(part, one['device'])} / {platform(part, compared[0]['device'])}"
        yield f"pass, {names}, {one['scene']}", ratio(one["pass"][key] / compared[0]["pass"][key], 0)


def growth_ratios(part):
    for series in part.get("growth", []):
        for name, law in series["exponents"].items():
            yield f"exponent of {name} by {series['subject']}, {platform(part, series['device'])}", ratio(
                law["exponent"], law["standardError"])


def micro_ratios(part):
    """Of single stages to native code; the best of several turns, so the spread is not known."""
    for row in (part.get("micro") or {}).get("rows", []):
        for name, value in row["ratios"].items():
            yield f"micro, {row['part']}, {row['case']}, {name}, threads: {row['threads']}", ratio(value, 0)


def ratios_of(parts):
    """By a name that says what is divided, on which scene and platform."""
    found = {}
    for part in parts.values():
        for collect in (error_ratios, kernel_ratios, thread_ratios, device_ratios, growth_ratios, micro_ratios):
            found.update(collect(part))
    return found


def changes(kept, now):
    """A line for each ratio that changed by more than its spread, or is in one of the two only."""
    lines = []
    for name in sorted(kept.keys() | now.keys()):
        if name not in now or name not in kept:
            lines.append(f"{'gone' if name in kept else 'new '}     {name}: {(kept.get(name) or now[name])['value']:g}")
            continue
        old, new = kept[name], now[name]
        difference = new["value"] - old["value"]
        spread = math.hypot(old["spread"], new["spread"])
        if abs(difference) > max(SIGNIFICANT * spread, LEAST_CHANGE * abs(old["value"])):
            lines.append(f"changed  {name}: {old['value']:g} +- {old['spread']:g} -> {new['value']:g} +- {new['spread']:g}")
    return lines
