"""The memory of a machine, as kernels tell it: whole, and within control groups."""

import pytest

from branchcrush.files.memory import Memory, machine_memory

MEMINFO = "MemTotal:       8000000 kB\nMemFree: 1 kB\nMemAvailable:   6000000 kB\n"
V2 = "0::/user.slice/job_7\n"
V1 = "9:name=systemd:/\n4:cpu,memory:/job_7\n0::/\n"


@pytest.fixture
def kernel(tmp_path):
    """Return a function that writes the kernel's files below a folder, and returns it."""

    def write(files):
        for name, text in files.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return tmp_path

    return write


def test_without_control_groups_it_is_that_of_the_machine(kernel):
    root = kernel({"proc/meminfo": MEMINFO})
    assert machine_memory(root) == Memory(8.192e9, 6.144e9)


def test_no_such_kernel_tells_nothing(tmp_path):
    assert machine_memory(tmp_path) is None
    assert machine_memory() is not None


@pytest.mark.parametrize("above", [False, True])
def test_a_limit_of_version_2_holds_for_all_groups_below(kernel, above):
    group = "sys/fs/cgroup/user.slice" + ("" if above else "/job_7")
    root = kernel(
        {
            "proc/meminfo": MEMINFO,
            "proc/self/cgroup": V2,
            "sys/fs/cgroup/user.slice/job_7/memory.max": "max\n",
            "sys/fs/cgroup/user.slice/job_7/memory.current": "5\n",
            f"{group}/memory.max": "4000000000\n",
            f"{group}/memory.current": "1000000000\n",
        }
    )
    assert machine_memory(root) == Memory(4e9, 3e9)


def test_a_limit_of_version_1_has_a_tree_of_its_own(kernel):
    group = "sys/fs/cgroup/memory/job_7"
    root = kernel(
        {
            "proc/meminfo": MEMINFO,
            "proc/self/cgroup": V1,
            f"{group}/memory.limit_in_bytes": "4000000000\n",
            f"{group}/memory.usage_in_bytes": "5000000000\n",
        }
    )
    assert machine_memory(root) == Memory(4e9, 0.0)


@pytest.mark.parametrize(
    ("told", "files", "inactive"),
    [
        (V2, ("user.slice/job_7/memory.max", "user.slice/job_7/memory.current"), "inactive_file"),
        (
            V1,
            ("memory/job_7/memory.limit_in_bytes", "memory/job_7/memory.usage_in_bytes"),
            "total_inactive_file",
        ),
    ],
)
def test_copies_of_files_that_the_kernel_lets_go_are_free(kernel, told, files, inactive):
    limit, used = (f"sys/fs/cgroup/{file}" for file in files)
    stat = f"anon 900000000\n{inactive} 2500000000\nactive_file 100000000\n"
    root = kernel(
        {
            "proc/meminfo": MEMINFO,
            "proc/self/cgroup": told,
            limit: "4000000000\n",
            used: "3500000000\n",
            f"{limit.rsplit('/', 1)[0]}/memory.stat": stat,
        }
    )
    assert machine_memory(root) == Memory(4e9, 3e9)


def test_no_limit_of_version_1_is_a_number_larger_than_any_machine(kernel):
    root = kernel(
        {
            "proc/meminfo": MEMINFO,
            "proc/self/cgroup": V1,
            "sys/fs/cgroup/memory/memory.limit_in_bytes": "9223372036854771712\n",
            "sys/fs/cgroup/memory/memory.usage_in_bytes": "7\n",
        }
    )
    assert machine_memory(root) == Memory(8.192e9, 6.144e9)
