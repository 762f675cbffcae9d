local e = output.energy{ name = "energy" }
