#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bundles as a user makes, sends and checks them; simulation only. Usage: bundle_cli_test.py PROGRAM"""
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
SUITES = os.path.normpath(os.path.join(HERE, "../../../suites"))
SCHEMA = os.path.normpath(os.path.join(HERE, "../../bundle/manifest.schema.json"))
FEW = ("cia301/sdo/upload", "cia301/dictionary/1000-device-type")
OWN = """format: 1
title: Own

scenarios:
  - id: device-type
    title: The device type can be read
    risk: read-only
    steps:
      - upload: {object: 1000h:00}
        checks: OD-1000-01
        expect: {size: 4}
"""


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **options)


def call(*command, **options):
    return subprocess.run(command, capture_output=True, check=True, timeout=60, **options).stdout


def read(path):
    with open(path, "rb") as file:
        return file.read()


class Bundles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.bundle = self.path("run.tar.zst")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def make(self, *arguments, code=0):
        done = run("run", "--simulate", "-q", "--bundle", self.bundle, *FEW, *arguments)
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr)
        return done

    def unpack(self, bundle=None):
        """Not by our own program: what others get from it."""
        out = tempfile.mkdtemp(dir=self.folder)
        call("tar", "--zstd", "-xf", bundle or self.bundle, "-C", out)
        return out

    def pack(self, folder, *names):
        names = names or call("tar", "--zstd", "-tf", self.bundle, text=True).split()
        call("tar", "--zstd", "-cf", self.bundle, "-C", folder, *names)

    def verify(self, *arguments, bundle=None):
        return run("verify", bundle or self.bundle, *arguments)

    def manifest(self, bundle=None):
        return json.loads(call("tar", "--zstd", "-xOf", bundle or self.bundle, "MANIFEST.json"))

    def names(self, role=None, bundle=None):
        return [file["name"] for file in self.manifest(bundle)["files"] if role in (None, file["role"])]

    def keys(self, name="key"):
        secret, public = self.path(name + ".pem"), self.path(name + ".pub.pem")
        call("openssl", "genpkey", "-algorithm", "ed25519", "-out", secret)
        call("openssl", "pkey", "-in", secret, "-pubout", "-out", public)
        return secret, public

    def test_a_bundle_holds_everything_and_is_good(self):
        own = self.path("my suite")
        self.write("my suite/own.yaml", OWN)
        waivers = self.write("accepted.yaml", "format: 1\nwaivers:\n  - requirement: OD-1003-06\n    reason: known\n")
        profile = self.write("device.yaml", "format: 1\nname: mine\nnode: 1\n")
        eds = self.path("my device.eds")
        with open(eds, "wb") as file:
            file.write(call(os.path.join(os.path.dirname(PROGRAM), "canopen-refnode"), "--print-eds"))
        self.make("--suites", own, "--waivers", waivers, "--device", profile, "--eds", eds, "own", "--csv", self.path("r.csv"),
                  "--json", self.path("result.json"), "--candump", self.path("run.log"), "--capture", self.path("run.pcapng"))
        done = self.verify()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for said in ("verdict     conforms (exit code 0)", "dut.vendor_id", "canopen-conform", "good: it is as it was sealed", "signature   none"):
            self.assertIn(said, done.stdout)
        self.assertEqual(self.names("result"), ["result.json"])
        self.assertEqual(self.names("report"), ["reports/junit.xml", "reports/markdown.md", "reports/report.csv", "reports/report.html"])
        self.assertEqual(self.names("capture"), ["captures/run.log", "captures/run.pcapng"])
        self.assertEqual(self.names("own suite"), ["own-suites/1-my%20suite/own.yaml"])
        self.assertEqual(self.names("profile"), ["inputs/profile/device.yaml"])
        self.assertEqual(self.names("description"), ["inputs/description/my%20device.eds"])
        self.assertEqual(self.names("waivers"), ["inputs/waivers/1-accepted.yaml"])
        self.assertIn("suites/cia301/sdo/upload.yaml", self.names("suite"))
        self.assertEqual(self.manifest()["left_out"], [])
        out = self.unpack()
        for name, path in (("result.json", self.path("result.json")), ("reports/report.csv", self.path("r.csv")),
                           ("captures/run.pcapng", self.path("run.pcapng")), ("captures/run.log", self.path("run.log")),
                           ("inputs/profile/device.yaml", profile), ("inputs/description/my%20device.eds", eds)):
            self.assertEqual(read(os.path.join(out, name)), read(path), name)
        # What was used is enough to do it again.
        again = run("run", "--simulate", "-q", "--suites", out + "/suites", "--suites", out + "/own-suites/1-my%20suite", "--device",
                    out + "/inputs/profile/device.yaml", "--eds", out + "/inputs/description/my%20device.eds", "--waivers",
                    out + "/inputs/waivers/1-accepted.yaml", *FEW, "own")
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        result = json.loads(read(out + "/result.json"))
        told = {each["name"]: each["value"] for each in result["run"]["properties"]}
        self.assertEqual(told["dut.description_digest"], hashlib.sha256(read(eds)).hexdigest())
        self.assertEqual(told["input.profile"], profile + " " + hashlib.sha256(read(profile)).hexdigest())

    def test_the_manifest_has_the_shape_that_is_documented(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("jsonschema (python3-jsonschema) is not installed")
        shape = json.loads(read(SCHEMA))
        jsonschema.Draft202012Validator.check_schema(shape)
        validator = jsonschema.Draft202012Validator(shape)
        self.make("--sign", self.keys()[0])
        validator.validate(self.manifest())
        run("run", "--simulate", "--bundle", self.bundle, "cia301/no-such-thing")
        validator.validate(self.manifest())

    def test_every_digest_is_that_of_the_file(self):
        self.make()
        out = self.unpack()
        manifest = self.manifest()
        there = sorted(os.path.relpath(os.path.join(folder, name), out) for folder, _, names in os.walk(out) for name in names)
        self.assertEqual(there, sorted(["MANIFEST.json"] + [file["name"] for file in manifest["files"]]))
        self.assertEqual([file["name"] for file in manifest["files"]], sorted(file["name"] for file in manifest["files"]))
        for file in manifest["files"]:
            content = read(os.path.join(out, file["name"]))
            self.assertEqual((file["size"], file["sha256"]), (len(content), hashlib.sha256(content).hexdigest()))

    def test_the_same_run_gives_the_same_bytes_wherever_it_goes(self):
        self.make("--seed", "7", "--defect", "1000-is-u16", code=1)
        first = read(self.bundle)
        self.bundle = self.path("other.tar.zst")
        self.make("--seed", "7", "--defect", "1000-is-u16", code=1)
        self.assertEqual(read(self.bundle), first)
        secret, _ = self.keys()
        self.make("--seed", "7", "--sign", secret)
        first = read(self.bundle)
        self.make("--seed", "7", "--sign", secret)
        self.assertEqual(read(self.bundle), first)
        listing = call("tar", "--zstd", "--full-time", "--numeric-owner", "-tvf", self.bundle, text=True, env=dict(os.environ, TZ="UTC")).splitlines()
        self.assertEqual({line.split()[0] for line in listing}, {"-rw-r--r--"})
        self.assertEqual({line.split()[1] for line in listing}, {"0/0"})
        self.assertEqual({line.split()[3] for line in listing}, {"1970-01-01"})

    def test_every_kind_of_tampering_exits_1_and_is_named(self):
        self.make()
        out = self.unpack()
        sealed = read(self.bundle)
        names = call("tar", "--zstd", "-tf", self.bundle, text=True).split()
        self.pack(out)
        self.assertEqual(self.verify().returncode, 0)  # the order and the rest of a tar are no tampering

        def again():
            with open(self.bundle, "wb") as file:
                file.write(sealed)
            shutil.rmtree(out)
            os.mkdir(out)
            call("tar", "--zstd", "-xf", self.bundle, "-C", out)

        def changed():
            path = os.path.join(out, "reports/junit.xml")
            content = bytearray(read(path))
            content[100] ^= 1
            with open(path, "wb") as file:
                file.write(content)
            self.pack(out)

        def removed():
            self.pack(out, *(name for name in names if name != "reports/junit.xml"))

        def added():
            self.write(os.path.join(out, "more.txt"), "more")
            self.pack(out, *names, "more.txt")

        def renamed():
            os.rename(os.path.join(out, "reports/junit.xml"), os.path.join(out, "reports/junit2.xml"))
            self.pack(out, *(name.replace("junit", "junit2") for name in names))

        def repeated():
            self.pack(out, *names, "--hard-dereference", "reports/junit.xml")

        def linked():
            os.remove(os.path.join(out, "reports/junit.xml"))
            os.symlink("report.html", os.path.join(out, "reports/junit.xml"))
            self.pack(out)

        def climbing():
            self.pack(out, *names, "-P", "--transform", "s,^result.json$,../result.json,")

        def cut():
            with open(self.bundle, "wb") as file:
                file.write(sealed[:len(sealed) // 2])

        def verdict():
            path = os.path.join(out, "MANIFEST.json")
            text = read(path).replace(b'"sha256":"', b'"sha256":"0', 1)
            with open(path, "wb") as file:
                file.write(text)
            self.pack(out)

        for how, said in ((changed, "changed: reports/junit.xml"), (removed, "missing: reports/junit.xml"), (added, "extra: more.txt"),
                          (renamed, "extra: reports/junit2.xml"), (repeated, "repeated: reports/junit.xml"), (linked, "not a file: reports/junit.xml"),
                          (climbing, "unsafe name: ../result.json"), (cut, "damaged: "), (verdict, "manifest: MANIFEST.json")):
            with self.subTest(how=how.__name__):
                again()
                how()
                done = self.verify("--extract", self.path("extracted"))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertIn(said, done.stdout)
                self.assertIn("NOT GOOD", done.stdout)
                self.assertFalse(os.path.exists(self.path("extracted")))
                told = json.loads(self.verify("--json").stdout)
                self.assertFalse(told["good"])
                self.assertTrue(told["problems"])

    def test_a_signature_is_that_of_the_key(self):
        secret, public = self.keys()
        _, other = self.keys("other")
        self.make("--sign", secret)
        done = self.verify("--key", public)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("signature   good", done.stdout)
        self.assertIn("not checked: --key", self.verify().stdout)
        done = self.verify("--key", other)
        self.assertEqual(done.returncode, 1)
        self.assertIn("it is signed with another key", done.stdout)
        # Others can check it without this program.
        out = self.unpack()
        call("openssl", "pkeyutl", "-verify", "-pubin", "-inkey", public, "-rawin", "-in", out + "/MANIFEST.json", "-sigfile", out + "/MANIFEST.sig")
        der = call("openssl", "pkey", "-pubin", "-in", public, "-outform", "DER")
        self.assertEqual(self.manifest()["signature"], {"algorithm": "Ed25519", "key_sha256": hashlib.sha256(der).hexdigest()})
        told = json.loads(self.verify("--json", "--key", public).stdout)
        self.assertEqual((told["good"], told["signature"]["state"], told["run"]["verdict"]), (True, "good", "conforms"))
        # A changed verdict is signed by nobody.
        path = os.path.join(out, "MANIFEST.json")
        with open(path, "rb+") as file:
            text = file.read().replace(b'"conforms"', b'"CONFORMS"')
            file.seek(0)
            file.write(text)
        self.pack(out)
        done = self.verify("--key", public)
        self.assertEqual(done.returncode, 1)
        self.assertIn("the signature is not that of this manifest", done.stdout)
        # Unsigned, with a key given.
        os.remove(self.bundle)
        self.make()
        done = self.verify("--key", public)
        self.assertEqual(done.returncode, 1)
        self.assertIn("it is not signed", done.stdout)

    def test_keys_that_do_not_fit_exit_2_before_anything_is_done(self):
        secret, public = self.keys()
        rsa = self.path("rsa.pem")
        call("openssl", "genpkey", "-algorithm", "rsa", "-out", rsa)
        for key, said in ((public, "public key"), (rsa, "no Ed25519 key"), (self.path("none"), "none")):
            done = run("run", "--simulate", "--bundle", self.bundle, "--sign", key)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.bundle))
        self.assertEqual(run("run", "--simulate", "--sign", secret).returncode, 2)
        self.make()
        done = self.verify("--key", secret)
        self.assertEqual(done.returncode, 2)
        self.assertIn("private key", done.stderr)
        self.assertEqual(run("run", "--simulate", "--bundle", secret, "--sign", secret).returncode, 3)
        self.assertIn(b"PRIVATE", read(secret))

    def test_what_is_no_bundle_exits_2(self):
        other = self.write("text.tar.zst", "no archive")
        foreign = self.path("foreign.tar.zst")
        call("tar", "--zstd", "-cf", foreign, "-C", self.folder, "text.tar.zst")
        for path in (other, foreign, self.path("none"), self.folder):
            done = self.verify(bundle=path)
            self.assertEqual(done.returncode, 2, path)
            self.assertIn("canopen-conform: " + path, done.stderr)
        self.assertFalse(json.loads(self.verify("--json", bundle=foreign).stdout)["good"])
        self.assertEqual(run("verify").returncode, 2)

    def test_what_is_good_is_unpacked(self):
        self.make()
        out = self.path("out")
        done = self.verify("--extract", out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        theirs = self.unpack()
        for folder, _, names in os.walk(theirs):
            for name in names:
                path = os.path.join(folder, name)
                self.assertEqual(read(path), read(os.path.join(out, os.path.relpath(path, theirs))))
        done = self.verify("--extract", out)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is not empty", done.stderr)

    def test_a_path_that_cannot_be_written_is_found_before_the_first_frame(self):
        done = run("run", "--simulate", "--bundle", self.path("no/such/folder/x.tar.zst"))
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertIn("create the folder first", done.stderr)
        done = run("run", "--simulate", "--bundle", self.bundle, "--junit", self.bundle)
        self.assertEqual(done.returncode, 3)
        self.assertIn("two reports", done.stderr)

    def test_no_stale_bundle_is_left_when_the_run_does_not_begin(self):
        self.make()
        done = run("run", "--simulate", "--bundle", self.bundle, "cia301/no-such-thing")
        self.assertEqual(done.returncode, 2)
        done = self.verify()
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("is not sealed: the run did not begin: nothing is selected", done.stderr)

    def die(self, *arguments, lines=40):
        process = subprocess.Popen([PROGRAM, "run", "--simulate", "--bundle", self.bundle, *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        for _ in range(lines):
            process.stdout.readline()
        during = self.verify()
        process.send_signal(signal.SIGKILL)
        process.stdout.read()
        process.stderr.read()
        process.stdout.close()
        process.stderr.close()
        process.wait(60)
        return during

    def test_a_run_that_dies_leaves_a_bundle_that_says_so(self):
        secret, public = self.keys()
        journal = self.path("run.journal")
        during = self.die("--journal", journal, "--sign", secret)
        self.assertEqual(during.returncode, 2, during.stdout)
        self.assertIn("is not sealed: the run has not ended", during.stderr)
        done = self.verify()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("stopped     the runner was killed before the run had ended", done.stdout)
        self.assertIn("verdict     not fully judged", done.stdout)
        self.assertIn("left out    signature: ", done.stdout)
        self.assertEqual(self.verify("--key", public).returncode, 1)  # nobody has signed it
        self.assertTrue(self.names("capture") and self.names("suite"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["key.pem", "key.pub.pem", "run.journal", "run.tar.zst"])
        # Who has looked at it may sign it.
        other = self.path("signed.tar.zst")
        again = run("report", journal, "-q", "--bundle", other, "--sign", secret)
        self.assertEqual(again.returncode, 3, again.stderr)
        done = self.verify("--key", public, bundle=other)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("stopped     the runner was killed", done.stdout)
        self.assertEqual(self.names(bundle=other), self.names())

    def test_a_bundle_is_made_anew_from_the_journal(self):
        journal = self.path("run.journal")
        self.make("--journal", journal, "--defect", "1000-is-u16", code=1)
        first = read(self.bundle)
        other = self.path("other.tar.zst")
        done = run("report", journal, "-q", "--bundle", other)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(read(other), first)
        self.assertEqual(run("report", journal, "-q").returncode, 1)
        self.assertEqual(read(self.bundle), first)

    def test_a_signed_bundle_is_not_replaced_by_one_that_is_not(self):
        journal = self.path("run.journal")
        self.make("--journal", journal, "--sign", self.keys()[0])
        first = read(self.bundle)
        done = run("report", journal, "-q")
        self.assertEqual(done.returncode, 3)
        self.assertIn("it is signed, and would not be any more", done.stderr)
        self.assertEqual(read(self.bundle), first)

    def test_a_bundle_of_a_result_has_what_is_still_the_same(self):
        result, capture = self.path("result.json"), self.path("run.pcapng")
        profile = self.write("device.yaml", "format: 1\nname: mine\nnode: 1\n")
        own = self.path("own")
        self.write("own/own.yaml", OWN)
        done = run("run", "--simulate", "-q", *FEW, "own", "--json", result, "--capture", capture, "--device", profile, "--suites", own, "--defect",
                   "1000-is-u16")
        self.assertEqual(done.returncode, 1)
        done = run("report", result, "-q", "--bundle", self.bundle, "--capture", capture)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.verify().returncode, 0)
        self.assertEqual(self.manifest()["left_out"], [])
        self.assertTrue(self.names("capture") and self.names("profile") and self.names("suite") and self.names("own suite"))
        # Others in their place are not taken for them.
        self.write("device.yaml", "format: 1\nname: mine\nnode: 2\n")
        self.write("own/own.yaml", OWN + "\n")
        run("run", "--simulate", "-q", "cia301/nmt", "--capture", capture)
        self.assertEqual(run("report", result, "-q", "--bundle", self.bundle, "--capture", capture).returncode, 1)
        done = self.verify()
        self.assertEqual(done.returncode, 0)
        self.assertEqual({each["what"] for each in self.manifest()["left_out"]}, {"capture", "profile", "own suite"})
        self.assertIn("left out    profile: ", done.stdout)
        self.assertFalse(self.names("capture") or self.names("profile") or self.names("own suite"))
        refused = run("report", result, "--bundle", result)
        self.assertEqual(refused.returncode, 2)
        self.assertEqual(json.loads(read(result))["canopen_conform_result"], 1)

    def test_a_judged_trace_has_a_bundle_with_the_trace_as_it_was(self):
        log = self.path("my trace.log")
        self.assertEqual(run("run", "--simulate", "-q", *FEW, "--candump", log).returncode, 0)
        done = run("judge", log, "--node", "1", "-q", "--bundle", self.bundle)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.verify().returncode, 0)
        self.assertEqual(self.names("recording"), ["inputs/recording/my%20trace.log"])
        self.assertEqual(self.names("capture"), ["captures/run.pcapng"])
        out = self.unpack()
        self.assertEqual(read(out + "/inputs/recording/my%20trace.log"), read(log))

    def test_hostile_texts_reach_no_terminal(self):
        self.make()
        out = self.unpack()
        path = os.path.join(out, "MANIFEST.json")
        manifest = json.loads(read(path))
        evil = "\x1b[2Jevil\u202e\x9b\n\rnext"
        manifest["tool"] = manifest["run"]["verdict"] = manifest["run"]["device"] = manifest["run"]["host"] = manifest["run"]["aborted"] = evil
        manifest["run"]["identity"] = {evil: evil}
        manifest["run"]["requirements"] = {evil: 1}
        manifest["left_out"] = [{"what": evil, "why": evil}]
        manifest["files"][0]["role"] = evil
        with open(path, "w", encoding="utf-8") as file:
            json.dump(manifest, file, ensure_ascii=False)
        os.rename(os.path.join(out, "result.json"), os.path.join(out, "\x1b[2Jresult.json"))
        names = call("tar", "--zstd", "-tf", self.bundle, text=True).split()
        self.pack(out, *(name for name in names if name != "result.json"), "\x1b[2Jresult.json")
        for arguments in ((), ("--json",)):
            done = self.verify(*arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn("evil", done.stdout)
            for character in done.stdout + done.stderr:
                self.assertTrue(character == "\n" or (ord(character) >= 32 and not 0x7F <= ord(character) < 0xA0 and character != "\u202e"), repr(character))


if __name__ == "__main__":
    unittest.main(verbosity=2)
