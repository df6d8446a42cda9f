#!/usr/bin/python3
"""Simulates a render whose passes are shared among up to 1,000 nodes (docs/method/scaling.md).

    scaling.py [STATISTICS.json ...]   mean and spread of pass times from the `workers` of --stats; without: as options say

Passes are dealt as host/share/pass_dealer.cpp deals them. Prints a table by number of nodes: time, and efficiency against as many nodes that are
never idle.
"""
import argparse
import heapq
import json
import math

import numpy as np

BATCH = 4  # passes
SECONDS_AT_ONCE = 0.5
MOST_BATCHES = 256
FIRST_PASSES = 16  # on the first node alone: radii are chosen from them


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("statistics", nargs="*", help="of renders: times of passes")
    parser.add_argument("--passes", type=int, default=20000)
    parser.add_argument("--pass-seconds", type=float, default=1.0, help="mean, of a node that is not slow")
    parser.add_argument("--spread", type=float, default=0.05, help="standard deviation of pass times, relative to their mean")
    parser.add_argument("--slow", type=float, default=0.1, help="share of nodes that are slow")
    parser.add_argument("--slowness", type=float, default=3.0)
    parser.add_argument("--failures", type=float, default=1.0, help="of a node an hour")
    parser.add_argument("--learning", type=float, default=2.0, help="seconds")
    parser.add_argument("--opening", type=float, default=3.0, help="seconds: reading the scene, compiling")
    parser.add_argument("--pixels", type=int, default=1920 * 1080)
    parser.add_argument("--film-bytes", type=int, default=504, help="of a pixel")
    parser.add_argument("--bandwidth", type=float, default=1.25e9, help="of a link, bytes/s")
    parser.add_argument("--adding", type=float, default=1.0e9, help="films added on a host, bytes/s")
    parser.add_argument("--every", type=float, default=60.0, help="seconds between checkpoints")
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


def measure(options):
    """Mean seconds of a pass and their relative spread, over all workers of these statistics."""
    workers = []
    for path in options.statistics:
        with open(path, encoding="utf-8") as file:
            workers += [one for one in json.load(file)["workers"] if one["passes"] > 0]
    if not workers:
        return
    passes = sum(one["passes"] for one in workers)
    options.pass_seconds = sum(one["seconds"] for one in workers) / passes
    options.spread = math.sqrt(sum(one["passes"] * one["spread"] ** 2 for one in workers) / passes)


def reduction_seconds(options, nodes):
    """Films travel up a binary tree in pieces of 2^18 pixels, so levels overlap but for one piece each."""
    if nodes == 1:
        return 0.0
    film = options.pixels * options.film_bytes
    piece = min(options.pixels, 1 << 18) * options.film_bytes
    rate = 1 / (1 / options.bandwidth + 1 / options.adding)
    return film / rate + (math.ceil(math.log2(nodes)) - 1) * piece / rate


class Simulation:
    """One render. Nodes that fail are lost; with `restarts` the whole job is, and begins again from its last checkpoint."""

    def __init__(self, options, nodes, rng):
        self.options, self.nodes, self.rng = options, nodes, rng
        slow = rng.random(nodes) < options.slow
        slow[0] = False
        self.seconds = options.pass_seconds * np.where(slow, options.slowness, 1.0)

    def noise(self, passes):
        """Of the mean of so many passes: lognormal."""
        return math.exp(self.rng.normal(0, self.options.spread / math.sqrt(passes)))

    def batches_for(self, node, known, left):
        if not known[node]:
            return 1
        of_batch = BATCH * self.seconds[node]
        return int(max(1, min(MOST_BATCHES, SECONDS_AT_ONCE / of_batch, left / (2 * self.nodes))))

    def is_worth_it(self, node, known, alive, free_at, now, left):
        if not known[node] or left > self.nodes * 64:
            return True
        others = alive & known
        others[node] = False
        within = (self.seconds[node] - np.maximum(free_at[others] - now, 0) / BATCH) / self.seconds[others]
        return np.maximum(0, np.ceil(within) - 1).sum() < left

    def run(self, begin=0.0, passes=None):
        """Seconds until the image is there, nodes being lost one by one."""
        o = self.options
        passes = o.passes if passes is None else passes
        known = np.zeros(self.nodes, bool)
        alive = np.ones(self.nodes, bool)
        free_at = np.full(self.nodes, begin)
        rate = o.failures / 3600
        fails_at = self.rng.exponential(1 / rate, self.nodes) if rate > 0 else np.full(self.nodes, np.inf)
        fails_at[0] = np.inf  # rank 0: see restarts
        known[0] = True
        first = min(passes, FIRST_PASSES)
        start = begin + max(o.opening, o.learning + first * self.seconds[0])
        left = math.ceil((passes - first) / BATCH)
        reduce = reduction_seconds(o, self.nodes)
        between = max(1.0, 50 * reduce)
        queue = [(start, node, 0) for node in range(self.nodes)]
        since_sums = np.zeros(self.nodes)  # batches that are lost if it fails
        last_sums = start
        waiting, end = [], start
        while queue:
            now, node, done = heapq.heappop(queue)
            if not alive[node]:
                continue
            if fails_at[node] < now:
                alive[node] = False
                left += int(since_sums[node]) + done
                for other in waiting:
                    heapq.heappush(queue, (now, other, 0))
                waiting = []
                continue
            end = max(end, now if done else 0)
            since_sums[node] += done
            known[node] |= done > 0
            if now - last_sums > between:
                since_sums[:] = 0
                last_sums = now
            if left <= 0:
                continue
            if not self.is_worth_it(node, known, alive, free_at, now, left):
                waiting.append(node)
                continue
            batches = min(left, self.batches_for(node, known, left))
            left -= batches
            free_at[node] = now + batches * BATCH * self.seconds[node] * self.noise(batches * BATCH)
            heapq.heappush(queue, (free_at[node], node, batches))
        return end + reduce

    def restarts(self):
        """The same where a node that fails ends the job (Open MPI 4): it begins again from its last checkpoint, with a node in its place."""
        o = self.options
        whole = self.run()
        if o.failures <= 0:
            return whole
        start = o.opening
        work = whole - start
        done, now = 0.0, 0.0
        while now < 100 * whole:
            until = self.rng.exponential(3600 / o.failures / self.nodes)
            if start + work - done <= until:
                return now + start + work - done
            done += max(0.0, math.floor((until - start) / o.every) * o.every)
            now += until
        return math.inf


def main():
    options = arguments()
    measure(options)
    print(f"{options.passes} passes of {options.pass_seconds:.3g} s, spread {options.spread:.2g}, film {options.pixels * options.film_bytes / 1e6:.0f} MB, "
          f"{100 * options.slow:.0f} % of nodes {options.slowness:g} times slower, {options.failures:g} failures a node an hour")
    print(f"{'nodes':>6} {'reduction s':>12} {'no failure s':>13} {'efficiency':>11} {'nodes lost s':>13} {'efficiency':>11} {'job restarts s':>15} {'efficiency':>11}")
    work = options.passes * options.pass_seconds
    for nodes in (1, 2, 4, 10, 30, 100, 300, 1000):
        rng = np.random.default_rng(options.seed)
        cells = []
        for failures in (0.0, options.failures):
            now = argparse.Namespace(**{**vars(options), "failures": failures})
            one = Simulation(now, nodes, rng)
            ideal = work / (options.pass_seconds / one.seconds).sum()
            seconds = one.run()
            cells += [seconds, ideal / seconds]
        again = Simulation(options, nodes, rng)
        seconds = again.restarts()
        cells += [seconds, work / (options.pass_seconds / again.seconds).sum() / seconds]
        figures = " ".join(f"{value:{width}}" for value, width in zip(cells, ("13.1f", "11.3f", "13.1f", "11.3f", "15.1f", "11.3f")))
        print(f"{nodes:6d} {reduction_seconds(options, nodes):12.2f} {figures}")


if __name__ == "__main__":
    main()
