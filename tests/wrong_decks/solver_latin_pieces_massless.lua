local s = solver.latin{ pieces = 4, massless_contact = true }
