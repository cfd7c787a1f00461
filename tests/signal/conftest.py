from tests.radio.conftest import rigctld, server

__all__ = ["rigctld", "server"]
