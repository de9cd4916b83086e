#!/usr/bin/env python3
"""Replays vector packs in cocotb on Icarus Verilog: driven from Python, without the bench in Verilog.

    python scripts/replay.py PACK... [--rtl rtl] [--stall 0] [--timeout SECONDS] [--wheatstone PROGRAM | --checked]

A pack is a folder that `wheatstone vectors` wrote; docs/vectors.md says what is in it. It may come from
anybody: `wheatstone check --copy` checks it and copies it, and the copy is replayed. With --checked the
pack is replayed as it is, for one that you have made or checked yourself. Every input beat is offered
until it is taken, every output beat is compared in every bit, on clocks chosen at random. Prints the CRC of every output stream and PASS or FAIL; exit status 0 if all packs pass, 1 if not, 2 if a
pack or the Verilog cannot be read, 3 if a tool is missing, 4 if it did not end in time, 128 and the number of the
signal that ended it; of a check that did not end well, its own. Whatever ends it, nothing that it has started and no
temporary file is left.
"""

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

BAD_INPUT = 2  # exit status
MISSING_TOOL = 3  # exit status
UNFINISHED = 4  # exit status


def stop(status, why):
    """Ends the program with a line that says why."""
    print(f"error: {why}", file=sys.stderr)
    sys.exit(status)


try:
    import cocotb
    from cocotb.clock import Clock
    from cocotb.triggers import FallingEdge, RisingEdge
    from cocotb_tools.runner import get_results, get_runner
except ImportError as error:
    stop(MISSING_TOOL, f"{error}; run scripts/setup, then this with target/wheatstone/python/bin/python")

QUIET = 64  # clocks after the last beat, on which none may come
HANGS = 2_000  # clocks without a beat
SHOWN = 10  # differences
MANY = 1_000  # differences: the module may never end
LIMIT = 3_600  # seconds
PATIENCE = 10  # seconds until it is told what is waited for, and then four times as many


def program(named):
    """The program that checks packs: the one that was named, or built beside this script, or installed."""
    here = Path(__file__).resolve().parent.parent / "target"
    built = [path for kind in ("release", "debug") if (path := here / kind / "wheatstone").is_file()]
    # The one built last belongs to the sources.
    built.sort(key=lambda path: path.stat().st_mtime)
    found = shutil.which(named or (built[-1] if built else "wheatstone"))
    if not found:
        what = f"{named}: no such program" if named else "the program wheatstone, which checks packs, is not built"
        stop(MISSING_TOOL, f"{what}; run cargo build, or name it with --wheatstone PROGRAM")
    return found


def checked(wheatstone, pack, rtl, copy):
    """Copies a pack that the program finds sound; Verilog that it was not made for may be tried."""
    command = [wheatstone, "check", "--copy", copy, "--rtl", rtl, "--", pack]
    said = subprocess.run(command, capture_output=True, text=True, errors="replace")
    if said.returncode:
        print((said.stderr or said.stdout).strip() or f"{wheatstone} ended by itself", file=sys.stderr)
    if said.returncode not in (0, 1):
        # Python gives signals as numbers below 0.
        sys.exit(said.returncode if said.returncode > 0 else UNFINISHED)
    return copy


def need(entries, *keys):
    """Looks for keys in all entries of a list."""
    for entry in entries:
        for key in keys:
            entry[key]


def read(pack):
    """The manifest of a pack that has everything which is needed here."""
    try:
        manifest = json.loads((pack / "manifest.json").read_text("utf-8-sig"))
        need([manifest], "module", "seed")
        need(manifest["parameters"] + manifest["statics"] + manifest["flags"], "name", "value")
        need(manifest["ports"], "name", "direction", "bytes", "crc32")
        expected = 0  # bytes of outputs
        for port in manifest["ports"]:
            need(port["fields"], "name", "lsb", "bits")
            beats = (pack / port["bin"]["file"]).read_bytes()
            expected += 0 if port["direction"] == "input" else len(beats)
        if not expected and not manifest["flags"]:
            raise ValueError("nothing in it is compared: no output beat and no flag")
    except (OSError, ValueError, KeyError, TypeError) as error:
        why = f"manifest.json has no {error}" if isinstance(error, KeyError) else error
        stop(BAD_INPUT, f"{pack}: {why}; write packs with: wheatstone vectors TARGET --out DIR")
    return manifest


class Stream:
    """A stream of the module, with its beats and the ports of their fields."""

    def __init__(self, dut, pack, port):
        self.name = port["name"]
        data, size = (pack / port["bin"]["file"]).read_bytes(), port["bytes"]
        self.beats = [int.from_bytes(data[n : n + size], "little") for n in range(0, len(data), size)]
        self.bytes, self.crc, self.answers = size, port["crc32"], port.get("answers")
        self.input = port["direction"] == "input"
        own, back = ("i", "o") if self.input else ("o", "i")
        self.valid = getattr(dut, f"{self.name}_valid_{own}")
        self.ready = getattr(dut, f"{self.name}_ready_{back}")
        self.fields = [
            (getattr(dut, f"{self.name}_{field['name']}_{own}"), field["lsb"], field["bits"])
            for field in port["fields"]
        ]
        self.done = 0  # beats taken
        self.on = False  # offered, or ready
        self.taken = bytearray()  # of an output, as in the .bin file

    def drive(self, may, rng):
        """Between two rising edges: begins to offer a beat, or is ready, where it `may`."""
        if not self.input:
            self.on = may
            self.ready.value = int(may)
        elif not self.on:
            self.on = may and self.done < len(self.beats)
            self.valid.value = int(self.on)
            for port, lsb, bits in self.fields:
                # Without a beat anything: the module must not look.
                beat = self.beats[self.done] >> lsb if self.on else rng.getrandbits(bits)
                port.value = beat & ((1 << bits) - 1)

    def sample(self):
        """At a rising edge: whether a beat is taken."""
        if not self.on or not int((self.ready if self.input else self.valid).value):
            return False
        if self.input:
            self.on = False
        self.done += 1
        return True

    def difference(self):
        """What is wrong with the output beat just taken."""
        try:
            beat = sum(int(port.value) << lsb for port, lsb, _ in self.fields)
        except ValueError:
            beat = None  # some bit is unknown
        expected = self.beats[self.done - 1] if self.done <= len(self.beats) else None
        self.taken += (beat or 0).to_bytes(self.bytes, "little")
        if beat is not None and beat == expected:
            return None
        shown = ["unknown" if beat is None else f"{beat:x}", "none" if expected is None else f"{expected:x}"]
        return f"{self.name} beat {self.done - 1}: {shown[0]}, expected {shown[1]}"


async def reset(dut, streams, statics):
    """Sets the static inputs and holds the reset for some clocks."""
    for static in statics:
        getattr(dut, f"{static['name']}_i").value = static["value"]
    for stream in streams:
        stream.drive(False, random)
    dut.rst_i.value = 1
    for _ in range(4):
        await FallingEdge(dut.clk_i)
    dut.rst_i.value = 0


async def run(dut, streams, may):
    """Runs until all beats have passed, or nothing moves; returns the differences."""
    by_name, faults, idle = {stream.name: stream for stream in streams}, [], 0
    done = False
    while idle <= (QUIET if done else HANGS) and len(faults) <= MANY:
        for stream in streams:
            # A response waits for its request.
            asked = not stream.answers or stream.done < by_name[stream.answers].done
            stream.drive(asked and may(), random)
        await RisingEdge(dut.clk_i)
        moved = [stream for stream in streams if stream.sample()]
        faults += filter(None, (stream.difference() for stream in moved if not stream.input))
        idle = 0 if moved else idle + 1
        done = all(stream.done >= len(stream.beats) for stream in streams)
        await FallingEdge(dut.clk_i)
    hangs = [f"no beat for {idle} clocks, streams unfinished"] if idle > HANGS else []
    return faults[:SHOWN] + hangs + faults[SHOWN:]


@cocotb.test()
async def replay(dut):
    """Replays the pack that the environment names."""
    pack, stall = Path(os.environ["PACK"]), int(os.environ["STALL"])
    manifest = read(pack)
    random.seed(manifest["seed"])
    streams = [Stream(dut, pack, port) for port in manifest["ports"]]
    cocotb.start_soon(Clock(dut.clk_i, 10, "ns").start())
    await reset(dut, streams, manifest["statics"])
    faults = await run(dut, streams, lambda: not stall or random.random() < 0.75)
    for flag in manifest["flags"]:
        found = getattr(dut, f"{flag['name']}_o").value
        if str(int(found)) != str(flag["value"]):
            faults.append(f"flag {flag['name']}: {found}, expected {flag['value']}")
    for line in faults[: SHOWN + 1]:
        print(line)
    for stream in streams:
        if not stream.input:
            crc, count = f"{zlib.crc32(stream.taken):08x}", len(stream.beats)
            print(f"crc {stream.name} {crc}, expected {stream.crc}, {stream.done} of {count} beats")
            if crc != stream.crc and not faults:
                faults.append("crc")
    if not any(stream.beats for stream in streams if not stream.input):
        print("no output beat to compare, flags alone")
    print(f"FAIL ({len(faults)} differences)" if faults else "PASS", flush=True)
    assert not faults


def simulate(pack, manifest, rtl, sources, stall):
    """Compiles the pack's module and runs the test above in it; returns whether it passed."""
    with tempfile.TemporaryDirectory() as build:
        common = {"hdl_toplevel": manifest["module"], "build_dir": build}
        log = Path(build) / "log"
        runner = get_runner("icarus")
        try:
            runner.build(
                sources=sources,
                includes=[rtl],
                parameters={p["name"]: p["value"] for p in manifest["parameters"]},
                build_args=["-g2005"],
                timescale=("1ns", "1ps"),
                log_file=log,
                **common,
            )
        except subprocess.CalledProcessError:
            stop(BAD_INPUT, f"iverilog refuses {manifest['module']}:\n{log.read_text().strip()}")
        results = runner.test(
            test_module="replay",
            results_xml=str(Path(build) / "results.xml"),
            extra_env={"PACK": str(pack), "STALL": str(stall), "COCOTB_LOG_LEVEL": "ERROR"},
            log_file=log,
            **common,
        )
        said = log.read_text().splitlines()
        verdicts = [line for line in said if line.startswith(("PASS", "FAIL ("))]
        # What the simulator says besides is of interest only if there is no verdict.
        print("\n".join([s for s in said if is_ours(s)] if verdicts else said), flush=True)
        tests, failures = get_results(results)
        return tests == 1 and failures == 0 and verdicts == ["PASS"]


def is_ours(line):
    """Whether the test above printed the line."""
    return line.startswith(("crc ", "flag ", "no beat ", "no output beat ", "PASS", "FAIL (")) or ", expected " in line


def supervise(limit):
    """Runs this script again, in a process group and a temporary folder that end with it; returns its exit status."""

    def end(number, _):
        for ending in signals:
            signal.signal(ending, signal.SIG_IGN)  # Nothing interrupts what is cleaned now.
        sys.exit(128 + number)

    signals = [signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
    signals = [number for number in signals if signal.getsignal(number) != signal.SIG_IGN]
    with tempfile.TemporaryDirectory() as folder:
        again = [sys.executable, __file__, "--supervised", *sys.argv[1:]]
        child = subprocess.Popen(
            again, stdin=subprocess.DEVNULL, start_new_session=True, env={**os.environ, "TMPDIR": folder}
        )
        try:
            for number in signals:
                signal.signal(number, end)
            start, told = time.monotonic(), PATIENCE
            # Until it is waited for, below, its number is that of its group alone.
            while not os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT):
                elapsed = time.monotonic() - start
                if elapsed >= limit:
                    why = "it was stopped, with all that it had started; where it needs longer, say so with --timeout SECONDS"
                    stop(UNFINISHED, f"the replay did not end within {limit} s; {why}")
                if elapsed >= told:
                    print(f"waiting for the replay for {told} s, until {limit} s", file=sys.stderr, flush=True)
                    told *= 4
                time.sleep(0.05)
        finally:
            os.killpg(child.pid, signal.SIGKILL)
            status = child.wait()
        return status if status >= 0 else 128 - status


def seconds(text):
    """A limit of time."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text}: expected a number of seconds, 1 or more")
    return int(text)


def main():
    """Replays the packs of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("packs", nargs="+", type=Path, metavar="PACK")
    parser.add_argument("--rtl", type=Path, default=Path("rtl"), help="folder of the Verilog")
    parser.add_argument("--stall", type=int, default=1, help="0: offer and take on every clock")
    parser.add_argument("--timeout", type=seconds, default=LIMIT, metavar="SECONDS", help="limit [default: an hour]")
    parser.add_argument("--supervised", action="store_true", help=argparse.SUPPRESS)
    trust = parser.add_mutually_exclusive_group()
    trust.add_argument("--wheatstone", metavar="PROGRAM", help="program that checks the packs")
    trust.add_argument("--checked", action="store_true", help="replay the packs as they are")
    args = parser.parse_args()
    if not shutil.which("iverilog"):
        stop(MISSING_TOOL, "iverilog is not installed; run scripts/setup")
    rtl = args.rtl.resolve()
    sources = sorted(rtl.glob("*.v"))
    if not sources:
        stop(BAD_INPUT, f"{args.rtl}: no Verilog there; name its folder with --rtl DIR")
    for file in [*sources, *sorted(rtl.glob("*.vh"))]:
        if not file.is_file():
            stop(BAD_INPUT, f"{file}: expected a regular file; remove it, or name another folder with --rtl DIR")
    if not args.supervised:
        sys.exit(supervise(args.timeout))
    wheatstone = None if args.checked else program(args.wheatstone)
    with tempfile.TemporaryDirectory() as copies:
        packs = []
        for number, pack in enumerate(args.packs):
            pack = pack.resolve()
            if wheatstone:
                pack = checked(wheatstone, pack, rtl, Path(copies) / str(number))
            packs.append((pack, read(pack)))
        passed = [simulate(pack, manifest, rtl, sources, args.stall) for pack, manifest in packs]
    sys.exit(0 if all(passed) else 1)


if __name__ == "__main__":
    main()
