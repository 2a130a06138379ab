# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the sources keep the rules of Documentation/Style.md that a machine can check."""

import re
import unittest

import house

INCLUDE = re.compile(r'^\s*#\s*include\s*"(\w+)/')
COMMENT = re.compile(r"//+<?\s*(.*)|^\s*/?\*+(?!/)\s*(.*)")
FRAGMENT = re.compile(r"(Of|The same|Whatever|Whoever)\b|\.\.\.")

# Comments that begin as fragments. The numbers may only go down.
MOST_FRAGMENTS = {"Filters": 0, "Plugin": 0, "Representations": 1, "Testing": 0,
                  "cuda/backend": 0, "cuda/compute": 0, "cuda/distributed": 0, "cuda/energy": 0, "cuda/math": 0,
                  "cuda/methods": 0, "cuda/optimize": 0, "cuda/render": 0, "cuda/scene": 0,
                  "cuda/sweep": 0, "cuda/viewpoint": 0}

# What crosses the folders of the core. The numbers may only go down.
CROSSES = [
    ("ranks", re.compile(r'\b([Rr]anks?|[Cc]ommunicator)\b|"distributed/'), 24,
     "work on processes that share a scene belongs into cuda/distributed/; others ask the scene, the "
     "fields or the rays that they have"),
    ("the memory of a device", re.compile(r"\breadsHostMemory\b"), 6,
     "let the arrays of a device decide (cuda/backend/DeviceArray.h)")]



def core(*patterns):
    return house.files(*patterns, under=["cuda"])


def fragments(path):
    """Numbers and texts of the lines on which a comment begins as a fragment."""
    found = []
    inside = False
    for number, line in house.lines(path):
        comment = COMMENT.search(line)
        words = (comment.group(1) or comment.group(2) or "") if comment else ""
        begins = comment and not (inside and not line[:comment.start()].strip())
        if begins and FRAGMENT.match(words):
            found.append(f"{path}:{number}: {line.strip()}")
        inside = bool(comment) and (bool(words) or inside and "/**" not in line)
    return found


def folder_of(path):
    """The step of the computation that a file of the core belongs to."""
    return path.parts[1] if len(path.parts) > 2 else None


class TestSources(unittest.TestCase):
    def test_few_files_know_what_has_a_folder_of_its_own(self):
        for what, pattern, most, why in CROSSES:
            found = [str(path) for path in core("*.h", "*.cxx")
                     if folder_of(path) != "distributed" and pattern.search(house.text(path))]
            with self.subTest(what):
                self.assertLessEqual(len(found), most, "\n".join([f"More files know {what}: {why}."] + found))

    def refuse(self, pattern, files, why, allowed=lambda path: False):
        """No line of the files matches."""
        found = [f"{path}:{number}: {line.strip()}" for path in files if not allowed(path)
                 for number, line in house.lines(path) if re.search(pattern, line)]
        self.assertFalse(found, "\n".join([why] + found))

    def test_includes_go_the_way_the_folders_are_listed(self):
        order = [house.quoted(row[0])[0] for row in house.rows("cuda/README.md", "# The core")]
        wrong = []
        for path in core("*.h", "*.cxx"):
            own = folder_of(path)
            self.assertIn(own, order, f"{path}: cuda/README.md does not list the folder")
            allowed = set(order[:order.index(own) + 1])
            allowed -= {"viewpoint": {"render"}, "render": {"viewpoint"}}.get(own, set())
            for number, line in house.lines(path):
                included = INCLUDE.match(line)
                if included and included.group(1) not in allowed:
                    wrong.append(f"{path}:{number}: {line}")
        self.assertFalse(wrong, "\n".join(["A folder includes only what is listed before it."] + wrong))

    def test_every_folder_that_the_core_lists_exists(self):
        for row in house.rows("cuda/README.md", "# The core"):
            self.assertTrue((house.ROOT / "cuda" / house.quoted(row[0])[0]).is_dir(), row[0])

    def test_the_core_knows_no_vtk(self):
        self.refuse(r'#\s*include\s*[<"]vtk|\bvtk[A-Z]|find_package\((VTK|ParaView)|VTK::',
                    core("*.h", "*.cxx", "CMakeLists.txt"), "cuda/ knows no VTK.")

    def test_headers_of_vtk_classes_know_no_core(self):
        headers = [path for path in house.files("vtk*.h", "vtk*.h.in", under=["Filters", "Representations"])
                   if "vtkTypeMacro" in house.text(path)]
        names = "|".join({folder_of(path) for path in core("*.h")} - {None})
        self.refuse(rf'#\s*include\s*"({names})/', headers, "A core type in a VTK header.")

    def test_compilers_are_told_apart_in_backend_and_math_alone(self):
        self.refuse(r"^\s*#.*__CUDACC__|__CUDA_ARCH__", core("*.h", "*.cxx"),
                    "The home of such differences is cuda/backend and math/Macros.h.",
                    lambda path: folder_of(path) in ("backend", "math"))

    def test_threads_and_devices_appear_in_backend_alone(self):
        self.refuse(r"std::(thread|async|jthread)\b|\btbb::|#\s*include\s*<(thread|tbb|oneapi)|"
                    r"#\s*pragma\s+omp|\w\s*<<<|\bcuda[A-Z]\w*\(|\b__(global|shared|syncthreads)\b",
                    core("*.h", "*.cxx"), "Threads, streams and device memory are cuda/backend's.",
                    lambda path: folder_of(path) == "backend")

    def test_comments_begin_as_sentences(self):
        for folder, most in MOST_FRAGMENTS.items():
            found = [line for path in house.files("*.h", "*.cxx", under=[folder])
                     for line in fragments(path)]
            self.assertLessEqual(len(found), most, "\n".join(
                [f"{folder}: say what the subject is, instead of Of, The same, Whatever, Whoever."]
                + found))

    def test_every_source_has_its_licence(self):
        kinds = ("*.h", "*.cxx", "*.py", "*.sh", "*.cmake", "CMakeLists.txt", "*.xml", "*.module",
                 "*.plugin", "*.qrc", "*.in", "*.yml", "*.yaml", "run")
        for path in house.files(*kinds) + ["CMakeLists.txt"]:
            head = house.text(path)[:400]
            # REUSE-IgnoreStart
            self.assertIn("SPDX-FileCopyrightText: Copyright (c) Limpid developers", head, path)
            self.assertIn("SPDX-License-Identifier: BSD-3-Clause", head, path)
            # REUSE-IgnoreEnd

    def test_nothing_depends_on_one_machine(self):
        readable = [path for path in house.files("*") + house.top_files()
                    if path.suffix not in (".png", ".jpg")]
        self.refuse(r"(^|[^\w.])/(home|root|work|mnt|srv|Users)/", readable,
                    "An absolute path of one machine.", lambda path: path.name == "TestSources.py")
        self.refuse(r"(https?|git|ftp)://(?!doi\.org/|www\.w3\.org/)", readable,
                    "The address of a server.", lambda path: path.name == "TestSources.py")


if __name__ == "__main__":
    unittest.main()
