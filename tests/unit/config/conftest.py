"""The folder that a study is checked in."""

import os

import pytest


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def locked(monkeypatch, folder):
    """Return a function that takes all permissions from a path, also for who is allowed all."""

    def lock(name):
        asked = folder / name
        monkeypatch.setattr(os, "access", lambda path, _: (folder / path).resolve() != asked)

    return lock
