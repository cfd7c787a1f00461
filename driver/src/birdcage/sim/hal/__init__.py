"""The simulated Winegard Trav'ler LG-2112 with firmware HAL 2.05.003 (`docs/reference/travler.md`)."""
