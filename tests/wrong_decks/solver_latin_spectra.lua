local s = solver.latin{ spectra = "0.1 dB" }
