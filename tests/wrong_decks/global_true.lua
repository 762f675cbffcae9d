local law = interface.plastic{ name = "shank", compression = True }
