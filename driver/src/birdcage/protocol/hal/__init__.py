"""The Winegard Trav'ler family, which calls its firmware HAL (reference sections 3 and 4)."""
