"""What lies on the desk: the open rig and what is made of it, kept, and shown."""
